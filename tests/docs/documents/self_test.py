"""Shows that each check fails for a wrong name and passes for a right one."""
from .names import check_names
from .whole import MAX_README_WORDS, check_limits, check_links, check_process_table

WRONG = {
    "plumb-nothing": "no program plumb-nothing",
    "`plumb-replay a.lcm --nothing`": "plumb-replay has no option --nothing",
    "`plumb-replay a.lcm --pose p`": "plumb-replay has no option --pose",  # a prefix of --poses
    "`plumb-eval plane t.txt e.csv --gt-dir d`": "plumb-eval plane has no option --gt-dir",
    "\n\n    plumb-vo --seed 1 & plumb-can --seed 1\n": "plumb-can has no option --seed",
    "`tools/live a b --nothing`": "tools/live has no option --nothing",
    "`--nothing-has-this`": "nothing has an option --nothing-has-this",
    "`vo.nothing_px`": "no setting vo.nothing_px",
    "`ground.filter.nothing`": "no setting ground.filter.nothing",
    "```toml\n[ground]\nnothing = 1\n```\n": "no setting ground.nothing",
    "NOTHING_AT_ALL": "neither a channel nor a constant of a message: NOTHING_AT_ALL",
    "`NOTHING`": "no channel NOTHING",
    "`nothing_t`": "no message nothing_t",
    "`ego_motion_t.nothing`": "ego_motion_t has no field nothing",
    "PLB_Nothing": "no CAN frame PLB_Nothing",
    "0x3AF": "no CAN frame has the identifier 0x3AF",
    "`EgoMotion_Nothing`": "no source has the word EgoMotion_Nothing",
    "`modules/nothing/nothing.cpp`": "no file modules/nothing/nothing.cpp",
    "`nothing_here.hpp`": "no file named nothing_here.hpp",
    "`build/release/tests/nothing_test`": "no test program nothing_test",
    "`nothing_of_ours`": "no source has the word nothing_of_ours",
    "`kNothingOfOurs`": "no source has the word kNothingOfOurs",
    "[a](nothing.md)": "broken link nothing.md",
    "[a](README.md#nothing)": "no heading for README.md#nothing",
}
RIGHT = ("`plumb-replay a.lcm --poses p` `plumb-eval plane t.txt e.csv --json j` `tools/live a b --speed 2` `--config FILE` "
         "`vo.max_tracks` `ground.filter.*` EGO_MOTION `CAMERA` `ego_motion_t.log_scale` PLB_EgoMotion 0x3A0 "
         "`EgoMotion_Speed` `core/numbers.hpp` `modules/vo/*_wire.cpp` `PlaneFilter` `kCueTable` [a](README.md)\n"
         "```toml\n[can.info]\ncycle_ms = 5000\n```\n")


def problems_of(text, tree):
    return list(check_names(text, tree)) + list(check_links(text, tree.root / "README.md"))


def self_test(tree):
    for text, expected in WRONG.items():
        found = problems_of(text, tree)
        assert found == [expected], f"{text!r} should give {expected!r}, not {found}"
    assert not problems_of(RIGHT, tree), problems_of(RIGHT, tree)
    assert list(check_limits("README.md", "word " * (MAX_README_WORDS + 1)))
    assert list(check_limits("README.md", "\n" * 111)) and not list(check_limits("README.md", "word\n"))
    table = (tree.root / "README.md").read_text(encoding="utf8")
    assert not list(check_process_table(table, tree)), list(check_process_table(table, tree))
    missing = table.replace("| CAMERA, CAMERA_CALIBRATION | VO_MOTION |", "| CAMERA | VO_MOTION |")
    assert any("plumb-vo reads" in problem for problem in check_process_table(missing, tree))
