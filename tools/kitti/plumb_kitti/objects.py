"""The sections of the report about objects and roads without truth: Fig. 12, and Tables 2 and 3."""
from plumb_kitti import paper_values
from plumb_kitti.blocks import bars, section, table
from plumb_kitti.results import read_json
from plumb_kitti.sections import MODE_NAMES
from plumb_tools.figures import cell

REACHES = ('close', 'distant')
FOOT, TRACKED, SPACE = 'foot_depth_error_percent', 'depth_error_percent', 'position_error_percent'
LAST_TRAINING = 8  # the paper trains on tracking sequences 0 to 8 and tests on 9 to 20
PLANES_OF_TABLE_3 = ('paper-dense', 'paper-fixed', 'paper')


def mean_over(entries, reaches, key):
    """(number of objects, mean of a figure over them) of several drives and reaches; None without any."""
    figures = [entry[reach]['all'] for entry in entries for reach in reaches]
    figures = [f for f in figures if f['num_samples'] and f[key] is not None]
    total = sum(f['num_samples'] for f in figures)
    return total, sum(f['num_samples'] * f[key] for f in figures) / total if total else None


def groups_of(plan):
    """{name: drives} of Fig. 12: every drive with boxes alone, and the tracking set's training and test sequences."""
    groups = {drive: [drive] for drive in plan['boxes']}
    tracking = [d for d in plan['boxes'] if plan['drives'][d]['kind'] == 'tracking' and '/training' in plan['drives'][d]['folder']]
    for name, wanted in (('tracking 0 to 8, training', lambda n: n <= LAST_TRAINING),
                         ('tracking 9 to 20, test', lambda n: n > LAST_TRAINING)):
        members = [drive for drive in tracking if wanted(int(plan['drives'][drive]['number']))]
        if members:
            groups[name] = members
    return groups


def placed_rows(results, group, drives):
    """(rows of the table, bars of the foot point, bars of the track) of a group of drives."""
    rows, foot, tracked = [], [], []
    for boxes in dict.fromkeys(b for drive in drives for b in results.plan['boxes'][drive]):
        for plane in results.plan['planes']:
            entries = [e for drive in drives if (e := results.placed(drive, boxes, plane))]
            refused = [e['refused'] for e in entries if 'refused' in e]
            entries = [e for e in entries if 'refused' not in e]
            name = MODE_NAMES.get(plane, plane)
            if refused and not entries:
                rows.append([group, boxes, name, refused[0]])
            if not entries:
                continue
            cells = []
            for reach in REACHES:
                num, foot_error = mean_over(entries, (reach,), FOOT)
                error = mean_over(entries, (reach,), TRACKED)[1]
                cells += [num, cell(foot_error, 1), cell(error, 1)]
                if num:
                    foot.append((f'{boxes}, {reach}', name, foot_error))
                    tracked.append((f'{boxes}, {reach}', name, error))
            rows.append([group, boxes, name, *cells])
    return rows, foot, tracked


def boxes_alone(results):
    """Rows of the tracking set's boxes without images."""
    rows = []
    for path in sorted((results.out / 'objects').glob('*/*.json')):
        entry = read_json(path)
        if '.part' not in path.name and entry:
            rows += [[path.stem, reach, entry['all'][reach]['num_samples'],
                      *(cell(m['depth_error_percent'], 1) for m in entry['all'][reach]['methods'])] for reach in REACHES]
    return rows


def figure_12(results):
    rows, charts = [], []
    for group, drives in groups_of(results.plan).items():
        more, foot, tracked = placed_rows(results, group, drives)
        rows += more
        charts += [bars(f'{group}: depth error of the foot point', 'error [%]', foot),
                   bars(f'{group}: depth error after tracking', 'error [%]', tracked)]
    head = ['drive', 'boxes', 'plane', 'close', 'foot point %', 'tracked %', 'distant', 'foot point %', 'tracked %']
    head_alone = ['boxes', '', 'objects', 'foot point, calibrated', 'foot point, cue', 'track, calibrated', 'track, cue']
    alone = boxes_alone(results)
    return section('fig12', 'Fig. 12: localisation of objects', [
        table(head, rows, 'The whole chain on drives with images and labels: label_02 are true boxes, the others those of '
              'trackers. Error of the depth in % of the truth; close is up to 10 m.') if rows else None, *charts,
        table(head_alone, alone, 'The tracking set from boxes alone, without images: depth error in %.') if alone else None],
        'Distant objects, foot point on planes of dense, fixed and adaptive: 17.6, 11.9, 9.2 %.')


def table_2(results):
    rows = [['The Hague ' + row[0], *row[1:3], row[3], '', ''] for row in paper_values.TABLE_2]
    for name, drive in results.plan['drives'].items():
        ends = {mode: results.runs.get((name, mode, 0), {}).get('end_point') for mode in ('default', 'paper')}
        if ends['default']:
            rows.append([name, drive['num_images'], cell(ends['default']['map_length_m']), '-',
                         *(cell(end['error_percent'] if end else None) for end in ends.values())])
    caption = 'Table 2: distance of the end from the beginning, against the map, in % of its length.'
    if not any(drive['map'] for drive in results.plan['drives'].values()):
        caption += ' No folder of images with a map.toml is here.'
    return table(['sequence', 'images', 'length m', 'the paper %', 'default %', 'paper, adaptive %'], rows, caption)


def table_3(results):
    rows = []
    for drive, objects, frames, *values in paper_values.TABLE_3:
        entries = [results.placed(drive, 'label_02', plane) for plane in PLANES_OF_TABLE_3]
        here = all(entry and 'refused' not in entry for entry in entries)
        ours = [cell(mean_over([entry], REACHES, key)[1], 1) if here else 'data not here'
                for key in (FOOT, SPACE) for entry in entries]
        rows.append([drive, objects, frames, *values, *ours])
    head = ['drive', 'objects', 'images', 'Choi and Savarese', 'dense', 'fixed', 'adaptive', 'our foot point: dense', 'fixed',
            'adaptive', 'our track: dense', 'fixed', 'adaptive']
    return table(head, rows, "Table 3: error of objects in % of their distance, with the tracklets' boxes (the paper's are those "
                 'of another tracker): depth of the foot point, and position of the track.')


def tables_2_and_3(results):
    return section('table2', 'Tables 2 and 3', [table_2(results), table_3(results)])
