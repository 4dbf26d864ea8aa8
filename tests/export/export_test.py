#!/usr/bin/env python3
"""Tests plumb-export on the drive that ships with the project: what its files say is what plumb-replay
says, to the bit where the format keeps it."""
import base64
import csv
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
from mcap_file import McapFile  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get('PLUMB_BIN', ROOT / 'build/release/bin'))
DRIVE = ROOT / 'tools/run/demo_drive/drive.lcm'


def run(program, *arguments):
    return subprocess.run([BIN / program, *map(str, arguments)], capture_output=True, text=True)


def matrix_of(q):
    """Rotation matrix of {x, y, z, w}."""
    x, y, z, w = q['x'], q['y'], q['z'], q['w']
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def times(matrix, vector):
    return [sum(row[i] * vector[i] for i in range(3)) for row in matrix]


def xyz(v):
    return [v['x'], v['y'], v['z']]


class Cdr:
    """A cursor over a message in CDR."""

    def __init__(self, data):
        assert data[:4] == b'\0\1\0\0'
        self.data, self.at = data[4:], 0

    def numbers(self, kind, count):
        size = struct.calcsize(kind)
        self.at += -self.at % size
        values = struct.unpack_from(f'<{count}{kind}', self.data, self.at)
        self.at += count * size
        return list(values)

    def text(self):
        size, = self.numbers('I', 1)
        self.at += size
        return self.data[self.at - size:self.at - 1].decode()

    def stamp_us(self):
        return self.numbers('i', 1)[0] * 1000000 + self.numbers('I', 1)[0] // 1000


def boxes(data, *path):
    """The contents of the boxes of an MP4 file with these names, from the outside to the inside."""
    at = 0
    while at + 8 <= len(data):
        size = int.from_bytes(data[at:at + 4], 'big') or len(data) - at
        if data[at + 4:at + 8] == path[0]:
            content = data[at + 8:at + size]
            yield from [content] if len(path) == 1 else boxes(content, *path[1:])
        at += size


class ExportTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        replay = run('plumb-replay', DRIVE, '--poses', cls.folder / 'replay.txt', '--no-times',
                     '--csv', cls.folder / 'replay.csv', '--objects', cls.folder / 'objects.csv')
        export = run('plumb-export', DRIVE, '--tum', cls.folder / 'a.tum', '--kitti', cls.folder / 'a.txt',
                     '--csv', cls.folder / 'a.csv', '--mcap', cls.folder / 'a.mcap', '--ros2', cls.folder / 'ros2.mcap',
                     '--video', cls.folder / 'a.mp4')
        assert (replay.returncode, export.returncode) == (0, 0), replay.stderr + export.stderr
        with open(cls.folder / 'replay.csv') as file:
            cls.rows = list(csv.DictReader(file))
        cls.mcap = McapFile(cls.folder / 'a.mcap')
        cls.ros2 = McapFile(cls.folder / 'ros2.mcap')

    def valid(self, column):
        """Time [us] -> row, for the rows that have a value in the column."""
        return {int(row['utime']): row for row in self.rows if row[column]}

    def json(self, topic):
        return [(ns, json.loads(data)) for ns, data in self.mcap.on(topic)]

    def transforms(self, child):
        return {ns // 1000: t for ns, message in self.json('/tf') for t in message['transforms']
                if t['child_frame_id'] == child}

    def test_text_files_are_those_of_the_replay(self):
        self.assertEqual((self.folder / 'a.txt').read_bytes(), (self.folder / 'replay.txt').read_bytes())
        self.assertEqual((self.folder / 'a.csv').read_bytes(), (self.folder / 'replay.csv').read_bytes())

    def test_tum_has_time_position_and_rotation(self):
        rows = [line.split(' ') for line in (self.folder / 'a.tum').read_text().splitlines()]
        valid = self.valid('x_m')
        self.assertEqual([int(row[0].replace('.', '')) for row in rows], list(valid))
        for row, truth in zip(rows, valid.values()):
            self.assertEqual([float(word) for word in row[1:4]], [float(truth[c]) for c in ('x_m', 'y_m', 'z_m')])
        poses = (self.folder / 'a.txt').read_text().splitlines()
        x, y, z, w = map(float, rows[-1][4:])
        matrix = matrix_of({'x': x, 'y': y, 'z': z, 'w': w})
        kitti = list(map(float, poses[-1].split()))
        for i in range(3):
            for k in range(3):
                self.assertAlmostEqual(matrix[i][k], kitti[4 * i + k], places=8)

    def test_vehicle_frame_drives_forward(self):
        done = run('plumb-export', DRIVE, '--tum', self.folder / 'v.tum', '--kitti', self.folder / 'v.txt', '--frame',
                   'vehicle')
        self.assertEqual(done.returncode, 0, done.stderr)
        first, last = [list(map(float, line.split())) for line in
                       (self.folder / 'v.tum').read_text().splitlines()[::97]]
        camera = list(map(float, (self.folder / 'a.tum').read_text().splitlines()[97].split()))
        # cam: x right, y down, z forward; vehicle: x forward, y left, z up.
        self.assertGreater(last[1], 50.0)
        self.assertLess(abs(last[1] - camera[3]), 0.02 * camera[3])
        self.assertLess(abs(last[2] + camera[1]), 0.02 * camera[3])
        kitti = list(map(float, (self.folder / 'v.txt').read_text().splitlines()[-1].split()))
        for place, value in zip((3, 7, 11), last[1:4]):
            self.assertAlmostEqual(kitti[place], value, places=6)

    def test_mcap_opens_as_foxglove_names_it(self):
        self.assertEqual(self.mcap.profile, '')
        types = {topic: self.mcap.type_of(topic) for topic, _, _ in self.mcap.messages}
        self.assertEqual(types, {
            '/camera/image': 'foxglove.CompressedImage', '/camera/calibration': 'foxglove.CameraCalibration',
            '/tf': 'foxglove.FrameTransforms', '/pose': 'foxglove.PoseInFrame', '/path': 'foxglove.PosesInFrame',
            '/road': 'foxglove.SceneUpdate', '/objects': 'foxglove.SceneUpdate', '/log': 'foxglove.Log',
            '/plumbline/frame': 'plumbline.Frame'})
        for schema in self.mcap.schemas.values():
            self.assertEqual(json.loads(schema['text'])['title'], schema['name'])

    def test_frames_have_every_value_of_the_table(self):
        messages = self.json('/plumbline/frame')
        self.assertEqual(len(messages), len(self.rows))
        for (ns, message), row in zip(messages, self.rows):
            self.assertEqual(ns, 1000 * int(row['utime']))
            self.assertEqual(sorted(message), sorted(name for name, cell in row.items() if cell))
            for name, value in message.items():
                self.assertEqual(value, row[name] if isinstance(value, str) else float(row[name]), name)

    def test_images_are_the_camera_s(self):
        images = self.json('/camera/image')
        self.assertEqual([ns // 1000 for ns, _ in images], [int(row['utime']) for row in self.rows])
        log = DRIVE.read_bytes()
        for _, message in images:
            jpeg = base64.b64decode(message['data'])
            self.assertIn(jpeg, log)  # the log has JPEG, which is handed on as it is
            self.assertEqual((jpeg[:2], jpeg[-2:]), (b'\xff\xd8', b'\xff\xd9'))

    def test_transforms_hold_pose_and_plane(self):
        mount = list(self.transforms('camera').values())[0]
        R = matrix_of(mount['rotation'])
        bodies = self.transforms('base_link')
        self.assertEqual(list(bodies), list(self.valid('x_m')))
        for time_us, row in self.valid('x_m').items():
            # The camera in odom is R (its position in world) + t, whatever the vehicle's rotation is.
            body, t = bodies[time_us], xyz(mount['translation'])
            camera = [p + q for p, q in zip(times(matrix_of(body['rotation']), t), xyz(body['translation']))]
            world = [float(row[c]) for c in ('x_m', 'y_m', 'z_m')]
            for got, expected in zip(camera, [p + q for p, q in zip(times(R, world), t)]):
                self.assertAlmostEqual(got, expected, places=9)
        roads = self.transforms('road')
        self.assertEqual(list(roads), list(self.valid('height_m')))
        for time_us, row in self.valid('height_m').items():
            # The origin of the road is under the camera, and its z axis is the normal, upwards.
            normal = [float(row[c]) for c in ('n1', 'n2', 'n3')]
            for got, n in zip(xyz(roads[time_us]['translation']), normal):
                self.assertAlmostEqual(got, n * float(row['height_m']), places=12)
            for got, n in zip(times(matrix_of(roads[time_us]['rotation']), [0, 0, 1]), normal):
                self.assertAlmostEqual(got, -n, places=9)

    def test_scene_has_the_objects_of_the_table(self):
        boxes = {}
        for ns, message in self.json('/objects'):
            self.assertEqual(message['deletions'][0]['type'], 1)
            for entity in message['entities']:
                boxes[ns // 1000, entity['id']] = entity['cubes'][0]
        with open(self.folder / 'objects.csv') as file:
            rows = [row for row in csv.DictReader(file) if row['status'] != 'not_localised']
        self.assertGreater(len(rows), 20)
        self.assertEqual(len(boxes), len(rows))
        for row in rows:
            box = boxes[int(row['utime']), f"object {row['track_id']}"]
            self.assertEqual(xyz(box['pose']['position'])[:2], [float(row['x_m']), float(row['y_m'])])
            self.assertEqual(xyz(box['size']), [float(row[c]) for c in ('length_m', 'width_m', 'height_m')])
            q = box['pose']['orientation']
            self.assertAlmostEqual(math.remainder(2 * math.atan2(q['z'], q['w']) - float(row['yaw_rad']),
                                                  2 * math.pi), 0.0, places=9)

    def test_log_names_every_change_of_status(self):
        told = [m['message'] for _, m in self.json('/log') if m['message'].startswith('motion')]
        expected, last = [], None
        for row in self.rows:
            if row['ego_status'] not in ('', last):
                last = row['ego_status']
                expected.append(f"motion: {last}, reason: {row['ego_reason']}")
        self.assertEqual(told, expected)

    def test_ros2_bag_has_the_standard_types(self):
        self.assertEqual(self.ros2.profile, 'ros2')
        types = {topic: self.ros2.type_of(topic) for topic, _, _ in self.ros2.messages}
        self.assertEqual(types, {
            '/odom': 'nav_msgs/msg/Odometry', '/camera/image/compressed': 'sensor_msgs/msg/CompressedImage',
            '/camera/camera_info': 'sensor_msgs/msg/CameraInfo', '/tf': 'tf2_msgs/msg/TFMessage',
            '/tf_static': 'tf2_msgs/msg/TFMessage', '/diagnostics': 'diagnostic_msgs/msg/DiagnosticArray'})

    def test_odometry_is_that_of_the_transforms(self):
        bodies, rows = self.transforms('base_link'), self.valid('x_m')
        height_m = list(self.transforms('camera').values())[0]['translation']['z']
        self.assertEqual([ns // 1000 for ns, _ in self.ros2.on('/odom')], list(rows))
        for ns, data in self.ros2.on('/odom'):
            cdr, row, body = Cdr(data), rows[ns // 1000], bodies[ns // 1000]
            self.assertEqual((cdr.stamp_us(), cdr.text(), cdr.text()), (ns // 1000, 'odom', 'base_link'))
            pose, covariance, twist, twist_covariance = (cdr.numbers('d', n) for n in (7, 36, 6, 36))
            self.assertEqual(cdr.at, len(cdr.data))
            self.assertEqual(pose[:3], xyz(body['translation']))
            self.assertEqual(pose[3:], [body['rotation'][c] for c in 'xyzw'])
            for i in range(6):
                self.assertGreaterEqual(covariance[7 * i], 0.0)
                for k in range(6):
                    self.assertAlmostEqual(covariance[6 * i + k], covariance[6 * k + i], places=12)
            if not row['speed_m_s']:
                self.assertEqual((twist, twist_covariance[0]), ([0.0] * 6, 1e9))
                continue
            # base_link is on the road: it moves as the camera does, without what pitching moves the camera.
            camera_m_s = twist[0] + twist[4] * height_m
            self.assertAlmostEqual(camera_m_s, float(row['speed_m_s']), delta=0.01 + 0.001 * abs(camera_m_s))
            self.assertAlmostEqual(twist[5], float(row['yaw_rate_rad_s']), delta=2e-3)
            self.assertGreaterEqual(twist_covariance[0] * (1 + 1e-12), float(row['speed_std_m_s']) ** 2)

    def test_video_is_as_long_as_the_drive(self):
        mp4 = (self.folder / 'a.mp4').read_bytes()
        header, = boxes(mp4, b'moov', b'mvhd')
        scale, duration = struct.unpack_from('>II', header, 12)
        table, = boxes(mp4, b'moov', b'trak', b'mdia', b'minf', b'stbl')
        (description,), (sizes,) = boxes(table, b'stsd'), boxes(table, b'stsz')
        self.assertEqual(description[12:16], b'avc1')
        width, height = struct.unpack_from('>HH', description, 40)
        # 832x252, and below it a strip of text.
        self.assertEqual(width, 832)
        self.assertGreater(height, 252 + 40)
        self.assertEqual(struct.unpack_from('>I', sizes, 8)[0], len(self.rows))
        seconds = (int(self.rows[-1]['utime']) - int(self.rows[0]['utime'])) * 1e-6
        self.assertAlmostEqual(duration / scale, seconds * len(self.rows) / (len(self.rows) - 1), delta=0.1)

    def test_video_holds_pictures_that_are_missing(self):
        log = bytearray()
        at = num_images = 0
        drive = DRIVE.read_bytes()
        while at < len(drive):
            channel_bytes, data_bytes = struct.unpack_from('>II', drive, at + 20)
            end = at + 28 + channel_bytes + data_bytes
            is_image = drive[at + 28:at + 28 + channel_bytes] == b'CAMERA'
            num_images += is_image
            if not is_image or num_images not in (40, 41, 42):
                log += drive[at:end]
            at = end
        self.assertEqual(num_images, len(self.rows))
        (self.folder / 'gap.lcm').write_bytes(log)
        done = run('plumb-export', self.folder / 'gap.lcm', '--video', self.folder / 'gap.avi')
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        avi = (self.folder / 'gap.avi').read_bytes()
        self.assertEqual((avi[:4], avi[8:12]), (b'RIFF', b'AVI '))
        header = avi.index(b'avih')
        self.assertEqual(struct.unpack_from('<I', avi, header + 8 + 16)[0], num_images)
        self.assertIn(b'vidsMJPG', avi)

    def test_exported_images_become_a_log_again(self):
        calibration = self.json('/camera/calibration')[0][1]
        fx, cx, fy, cy = (calibration['K'][i] for i in (0, 2, 4, 5))
        camera = self.folder / 'camera.toml'
        camera.write_text(f'[camera]\nfx_px = {fx}\nfy_px = {fy}\ncx_px = {cx}\ncy_px = {cy}\ncamera_height_m = 1.65\n')
        logs = []
        for name in ('a', 'ros2'):
            done = run('plumb-convert', self.folder / f'{name}.mcap', '--camera', camera, '--out', self.folder / 'back.lcm')
            self.assertEqual((done.returncode, done.stderr), (0, ''))
            self.assertIn('100 frames of 832x252, 9.9 s', done.stdout)
            logs.append((self.folder / 'back.lcm').read_bytes())
        self.assertEqual(logs[0], logs[1])

    def test_refuses_in_one_sentence(self):
        log = self.folder / 'copy.lcm'
        log.write_bytes(DRIVE.read_bytes()[:2000000])
        (self.folder / 'link.mp4').symlink_to(log)
        for arguments, sentence in [
                ([log, '--video', self.folder / 'x.mov'], 'x.mov ends neither in .mp4 nor in .avi'),
                ([log, '--video', self.folder / 'link.mp4'], 'would overwrite'),
                ([log, '--video', self.folder / 'no/folder.mp4'], 'cannot write'),
                ([log], 'nothing to write: give --tum, --kitti, --csv, --mcap, --ros2 or --video'),
                ([log, '--tum', log], 'would overwrite'),
                ([log, '--mcap', self.folder / 'x', '--ros2', self.folder / 'x'], '--ros2'),
                ([log, '--frame', 'vehicel', '--tum', self.folder / 'x'], 'vehicle'),
                ([self.folder / 'none.lcm', '--tum', self.folder / 'x'], 'none.lcm'),
                ([log, '--mcap', self.folder / 'no/folder'], 'cannot write'),
                ([self.folder / 'replay.csv', '--tum', self.folder / 'x'], 'replay.csv')]:
            done = run('plumb-export', *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(sentence, done.stderr)
            self.assertEqual(done.stderr.count('\n'), 1, done.stderr)
        self.assertEqual(len(log.read_bytes()), 2000000)


if __name__ == '__main__':
    unittest.main()
