"""Renders the drive of a case, once for its options and the renderer's sources."""
import hashlib
import shlex

from plumb_tools.programs import ROOT


def renderer_digest():
    """A short digest of the renderer's sources."""
    digest = hashlib.sha256()
    for file in sorted((ROOT / 'tools/synth').glob('*.?pp')):
        digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


def synth_options(default_text, case_text):
    """plumb-synth's options: those of the case, and the defaults that it does not repeat."""
    words, base = shlex.split(case_text), shlex.split(default_text)
    given = {word for word in words if word.startswith('--')}
    pairs = [base[i:i + 2] for i in range(0, len(base), 2)]
    return [word for pair in pairs if pair[0] not in given for word in pair] + words


def render(case, defaults, folder, programs, reuse):
    """(drive, log) of the case, rendered unless they are there already.

    With `reuse`, a drive of an older renderer is taken, too.
    """
    drive, log, stamp = folder / 'drive', folder / 'drive.lcm', folder / 'rendered.txt'
    options, log_options = synth_options(defaults['synth'], case['synth']), shlex.split(case.get('log', ''))
    wanted = [' '.join(options + log_options), renderer_digest()]
    found = stamp.read_text().splitlines() if stamp.exists() and log.exists() else []
    if found == wanted or (reuse and found[:1] == wanted[:1]):
        return drive, log
    folder.mkdir(parents=True, exist_ok=True)
    stamp.unlink(missing_ok=True)
    programs.run('plumb-synth', '--out', drive, '--force', '--quiet', *options)
    log.unlink(missing_ok=True)
    programs.run('plumb-kitti2lcm', drive, '--out', log, *log_options)
    stamp.write_text('\n'.join(wanted) + '\n')
    return drive, log
