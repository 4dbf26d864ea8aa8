"""Compares what the readers from npm found with the table of frames: compare.py CSV FOXGLOVE ROS2"""
import collections
import csv
import json
import sys


def messages(path):
    found = collections.defaultdict(list)
    with open(path) as file:
        for line in file:
            entry = json.loads(line)
            found[entry['topic']].append((int(entry['time_ns']), entry['message']))
    return found


def fail(sentence):
    sys.exit(f'compare.py: {sentence}')


def main(table, foxglove_path, ros2_path):
    with open(table) as file:
        rows = list(csv.DictReader(file))
    foxglove, ros2 = messages(foxglove_path), messages(ros2_path)
    times = [1000 * int(row['utime']) for row in rows]
    posed = [time for time, row in zip(times, rows) if row['x_m']]
    for found, topic, expected in ((foxglove, '/camera/image', times), (foxglove, '/plumbline/frame', times),
                                   (foxglove, '/pose', posed), (ros2, '/odom', posed),
                                   (ros2, '/camera/image/compressed', times), (ros2, '/camera/camera_info', times)):
        if [time for time, _ in found[topic]] != expected:
            fail(f'{topic} has other times than {table}')
    for (_, message), row in zip(foxglove['/plumbline/frame'], rows):
        for name, cell in row.items():
            value = message.get(name, '')
            if (value if isinstance(value, str) else float(value)) != (cell if isinstance(value, str) else float(cell)):
                fail(f"{name} of image {row['seq']} is {value} in MCAP and {cell} in the table")
    for (_, pose), (_, odometry) in zip(foxglove['/pose'], ros2['/odom']):
        if pose['pose'] != odometry['pose']['pose']:
            fail('the poses of the two files differ')
        if len(odometry['pose']['covariance']) != 36 or len(odometry['twist']['covariance']) != 36:
            fail('an odometry without covariance')
    images = zip(foxglove['/camera/image'], ros2['/camera/image/compressed'])
    if not all(a['data'] == b['data'] and b['data']['numBytes'] > 1000 for (_, a), (_, b) in images):
        fail('the images of the two files differ')
    calibration, info = foxglove['/camera/calibration'][0][1], ros2['/camera/camera_info'][0][1]
    if any(calibration[name] != info[name.lower()] for name in ('D', 'K', 'R', 'P')):
        fail('the calibrations differ')
    levels = {status['level'] for _, message in ros2['/diagnostics'] for status in message['status']}
    if levels != {0, 1}:
        fail(f'levels {levels} in /diagnostics')
    print(f'{len(rows)} images, {len(posed)} poses: the readers from npm agree with the table')


if __name__ == '__main__':
    main(*sys.argv[1:])
