"""Tests tools/kitti/plumb-kitti: what it finds, what it names as missing, how it stages and plans."""
import dataclasses
import json
import math
import os
import sys
import types
import unittest

import support

sys.path.insert(0, str(support.ROOT / 'tools/kitti'))
from plumb_kitti import discover, driver, jobs, keys, missing, plan, staging, tracklets, training_jobs
from plumb_tools.command_line import UsageError

PNG = b'\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR' + (1242).to_bytes(4, 'big') + (375).to_bytes(4, 'big')
P = '700 0 600 0 0 700 180 0 0 0 1 0'
TRACKING_CALIB = f'P0: {P}\nP1: {P}\nP2: {P}\nP3: {P}\nR_rect 1 0 0 0 1 0 0 0 1\n' \
                 'Tr_velo_cam 0 -1 0 1 0 0 -1 2 1 0 0 3\nTr_imu_velo 1 0 0 4 0 1 0 5 0 0 1 6\n'


class KittiTree(support.FolderTest):
    """A tree with pieces of all three data sets, at the places where the downloads put them."""

    def images(self, folder, names=('000000', '000001')):
        for name in names:
            path = self.folder / folder / f'{name}.png'
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(PNG)

    def setUp(self):
        super().setUp()
        self.images('kitti/dataset/sequences/04/image_0')
        self.write('kitti/dataset/sequences/04/calib.txt', f'P0: {P}\nTr: {P}\ncamera_height_m: 1.7\n')
        self.write('kitti/dataset/sequences/04/times.txt', '0\n0.1\n')
        self.write('kitti/dataset/poses/04.txt', '1 0 0 0 0 1 0 0 0 0 1 0\n' * 2)
        self.write('kitti/dataset/sequences/04/velodyne/000000.bin', '')
        self.images('kitti/dataset/sequences/13/image_2')
        self.images('kitti/tracking/training/image_02/0003')
        self.write('kitti/tracking/training/calib/0003.txt', TRACKING_CALIB)
        self.write('kitti/tracking/training/label_02/0003.txt', '0 1 Car 0 0 0 1 1 2 2 1 1 1 1 1 9 0\n')
        self.write('kitti/tracking/training/oxts/0003.txt', '1 2 3\n4 5 6\n')
        self.images('kitti/raw/2011_09_26/2011_09_26_drive_0009_sync/image_00/data', ('0000000000', '0000000001'))
        self.write('kitti/raw/2011_09_26/2011_09_26_drive_0009_sync/image_00/timestamps.txt', 'x\ny\n')
        self.write('kitti/raw/2011_09_26/calib_cam_to_cam.txt', f'P_rect_00: {P}\n')
        self.write('kitti/raw/2011_09_26/2011_09_26_drive_0009_sync/oxts/data/0000000000.txt', '1\n')
        self.drives = {drive.name: drive for drive in self.find()[0]}

    def find(self):
        return discover.find(self.folder / 'kitti')

    def plain(self, name):
        return dataclasses.asdict(self.drives[name])


class Discovery(KittiTree):
    def test_finds_all_three_sets(self):
        self.assertEqual({name: drive.kind for name, drive in self.drives.items()},
                         {'04': 'odometry', '13': 'odometry', 'tracking_0003': 'tracking',
                          '2011_09_26_drive_0009': 'raw'})
        four, raw = self.drives['04'], self.drives['2011_09_26_drive_0009']
        self.assertTrue(four.poses.endswith('dataset/poses/04.txt') and four.velodyne and not four.lacks)
        self.assertTrue(raw.oxts and raw.calib.endswith('2011_09_26/calib_cam_to_cam.txt'))
        self.assertEqual(self.find()[1], [self.folder / 'kitti/tracking/training'])
        self.assertTrue(self.drives['13'].for_server and not self.drives['13'].has_truth)
        self.assertEqual(self.drives['13'].camera, 2)

    def test_names_the_download_of_what_a_drive_lacks(self):
        self.assertEqual(self.drives['13'].lacks, ['calib (data_odometry_calib.zip)', 'times (data_odometry_calib.zip)'])
        rows = missing.rows_of([dataclasses.asdict(d) for d in self.drives.values()], ['x'], {})
        text = '\n'.join(' | '.join(row.values()) for row in rows)
        self.assertIn('images of sequences 00, 01, 02, 03, 05, 06, 07, 08, 09, 10 | data_odometry_gray.zip', text)
        self.assertIn('13 | calib | data_odometry_calib.zip', text)
        self.assertIn('2011_10_03_drive_0047_tracklets.zip', text)
        self.assertNotIn('labels of the tracking sequences', text)

    def test_refuses_what_is_no_kitti(self):
        self.write('other/readme.txt', '')
        with self.assertRaisesRegex(UsageError, 'holds no KITTI data'):
            discover.find(self.folder / 'other')
        self.images('kitti/again/sequences/04/image_0')
        with self.assertRaisesRegex(UsageError, 'two drives are named 04'):
            self.find()

    def test_dry_run_prints_all_of_it(self):
        code, out, err = self.run_script('kitti/plumb-kitti', self.folder / 'kitti', '--dry')
        self.assertEqual((code, err), (0, ''))
        self.assertRegex(out, r'tracking_0003 +tracking +2 images  truth, labels')
        self.assertIn('missing for Fig. 12', out)

    def test_refuses_wrong_options(self):
        tree = self.folder / 'kitti'
        self.assert_refused('kitti/plumb-kitti', [tree, '--drives', '4'], 'no drive 4; did you mean 04?')
        self.assert_refused('kitti/plumb-kitti', [tree, '--modes', 'papr'], 'did you mean paper?')
        self.assert_refused('kitti/plumb-kitti', [tree, '--others', 'ORB'], 'ORB is not NAME=FOLDER')
        self.assert_refused('kitti/plumb-kitti', [tree, '--trial', '2'], 'did you mean --trials?')


class Staging(KittiTree):
    def test_a_tracking_sequence_becomes_a_raw_drive(self):
        staging.stage(self.plain('tracking_0003'), self.folder / 'staged')
        cam = (self.folder / 'staged/calib_cam_to_cam.txt').read_text()
        self.assertIn('S_rect_02: 1242 375', cam)
        self.assertIn(f'P_rect_02: {P}', cam)
        self.assertIn('R_rect_00: 1 0 0 0 1 0 0 0 1', cam)
        self.assertEqual((self.folder / 'staged/calib_velo_to_cam.txt').read_text(), 'R: 0 -1 0 0 0 -1 1 0 0\nT: 1 2 3\n')
        self.assertEqual((self.folder / 'staged/oxts/data/0000000001.txt').read_text(), '4 5 6\n')
        stamps = (self.folder / 'staged/image_02/timestamps.txt').read_text().splitlines()
        self.assertEqual(stamps[1], '2012-01-01 00:00:00.100000000')
        self.assertTrue((self.folder / 'staged/image_02/data/000001.png').exists())

    def test_labels_come_only_when_asked_for(self):
        drive = self.plain('tracking_0003')
        staging.stage(drive, self.folder / 'staged')
        self.assertFalse((self.folder / 'staged/label_02.txt').exists())
        staging.stage(drive, self.folder / 'staged', with_labels=True)
        self.assertIn(f'P2: {P}', (self.folder / 'staged/calib.txt').read_text())
        self.assertTrue((self.folder / 'staged/label_02.txt').exists())


    def tracklet_drive(self):
        """The raw drive with a car 20 m ahead of the scanner and 2 m to the left, driving away; the third image has it no more."""
        raw = 'kitti/raw/2011_09_26/2011_09_26_drive_0009_sync'
        self.write('kitti/raw/2011_09_26/calib_velo_to_cam.txt', 'calib_time: x\nR: 0 -1 0 0 0 -1 1 0 0\nT: 0.1 -0.2 -0.3\n')
        self.write('kitti/raw/2011_09_26/calib_cam_to_cam.txt',
                   f'P_rect_00: {P}\nP_rect_02: {P}\nS_rect_02: 1242 375\nR_rect_00: 1 0 0 0 1 0 0 0 1\n')
        pose = '<item><tx>{}</tx><ty>2</ty><tz>-1.75</tz><rx>0</rx><ry>0</ry><rz>0</rz><occlusion>1</occlusion>' \
               '<truncation>{}</truncation></item>'
        poses = pose.format(20, 0) + pose.format(21, 0) + pose.format(-5, 99)
        self.write(f'{raw}/tracklet_labels.xml', '<boost_serialization><tracklets><count>1</count><item><objectType>Car'
                   '</objectType><h>1.5</h><w>1.6</w><l>4</l><first_frame>1</first_frame><poses><count>3</count>' + poses +
                   '</poses></item></tracklets></boost_serialization>')
        return dataclasses.asdict({drive.name: drive for drive in self.find()[0]}['2011_09_26_drive_0009'])

    def test_tracklets_become_labels(self):
        staging.stage(self.tracklet_drive(), self.folder / 'staged', with_labels=True)
        rows = [line.split() for line in (self.folder / 'staged/label_02.txt').read_text().splitlines()]
        self.assertEqual([row[:5] for row in rows], [['1', '0', 'Car', '0', '1'], ['2', '0', 'Car', '0', '1']])
        alpha, left, top, right, bottom, *rest = (float(word) for word in rows[0][5:])
        # x right is -y left, y down is -z up, z ahead; the box spans the nearest face and the farthest one.
        for value, wanted in zip(rest, (1.5, 1.6, 4, -1.9, 1.55, 19.7, -math.pi / 2)):
            self.assertAlmostEqual(value, wanted, places=5)
        self.assertAlmostEqual(left, 600 + 700 * (-1.9 - 0.8) / 17.7, places=3)
        self.assertAlmostEqual(right, 600 + 700 * (-1.9 + 0.8) / 21.7, places=3)
        self.assertAlmostEqual(bottom, 180 + 700 * 1.55 / 17.7, places=3)
        self.assertAlmostEqual(top, 180 + 700 * 0.05 / 21.7, places=3)
        self.assertAlmostEqual(alpha, -math.pi / 2 + math.atan2(1.9, 19.7), places=5)

    def test_refuses_what_are_no_tracklets(self):
        with self.assertRaisesRegex(UsageError, 'no element found'):
            tracklets.read(self.write('a.xml', ''))
        with self.assertRaisesRegex(UsageError, 'no tracklets/item in it'):
            tracklets.read(self.write('b.xml', '<boost_serialization/>'))
        with self.assertRaisesRegex(UsageError, 'a tracklet has no number w'):
            tracklets.read(self.write('c.xml', '<b><tracklets><item><h>1</h><w>x</w></item></tracklets></b>'))

    def test_a_map_states_how_the_road_ends(self):
        road = staging.read_map(self.write('map.toml', 'length_m = 100.0\nend_distance_m = 60\n'))
        self.assertEqual(road, {'length_m': 100.0, 'end_distance_m': 60, 'rate_hz': 10.0})
        path = [[1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, z] for x, z in ((0, 0), (0, 40), (30, 40))]
        end = jobs.end_point(path, road)
        self.assertEqual((end['path_m'], end['end_distance_m'], end['error_percent']), (70.0, 50.0, 10.0))
        for text, sentence in (('', 'length_m is missing'), ('length_m = -1', r'length_m = -1 is not a number in \[0.1'),
                               ('lenght_m = 1', 'unknown key lenght_m; did you mean length_m')):
            with self.assertRaisesRegex(UsageError, sentence):
                staging.read_map(self.write('map.toml', text))

    def test_a_folder_with_a_map_is_a_drive(self):
        self.images('hague/one/images')
        self.write('hague/one/map.toml', 'length_m = 609.34\n')
        drive, = discover.find(self.folder / 'hague')[0]
        self.assertEqual((drive.kind, drive.num_images, drive.lacks), ('folder', 2, ['camera.toml (docs/add_a_camera.md)']))
        self.write('hague/one/camera.toml', '[camera]\nfx_px = 500.0\ncamera_height_m = 1.4\n')
        drive, = discover.find(self.folder / 'hague')[0]
        facts, _ = plan.camera_facts(dataclasses.asdict(drive))
        self.assertEqual((facts['fx_px'], facts['height_m'], drive.lacks), (500.0, 1.4, []))


class Keys(KittiTree):
    """What makes a job run again: nothing but a change of what it depends on."""

    def setUp(self):
        super().setUp()
        self.options = types.SimpleNamespace(trials=1, modes=['default'], bin=self.folder / 'bin', detector=None)
        self.write('bin/plumb-replay', 'one')

    def written(self):
        """The keys that a call of plumb-kitti rewrites."""
        made = plan.make([self.plain('04')], [], self.options, {}, {})
        folder = self.folder / 'out/keys'
        before = {path: path.stat().st_mtime_ns for path in folder.rglob('*') if path.is_file()}
        keys.write(made, ['plumb-replay'], self.folder / 'out')
        return {str(path.relative_to(folder)) for path in folder.rglob('*') if path.is_file()
                and before.get(path) != path.stat().st_mtime_ns}

    def test_nothing_changed_rewrites_nothing(self):
        self.assertLessEqual({'steps', 'program/plumb-replay', 'mode/default', 'drive/04', 'trial/04/1'}, self.written())
        self.assertEqual(self.written(), set())

    def test_a_new_program_a_new_setting_or_new_data_is_seen(self):
        self.written()
        self.write('bin/plumb-replay', 'two')
        self.assertEqual(self.written(), {'program/plumb-replay'})
        self.addCleanup(plan.MODES.update, default=plan.MODES['default'])
        plan.MODES['default'] = '[ground]\n'
        self.assertEqual(self.written(), {'mode/default'})
        self.write('kitti/dataset/poses/04.txt', '1 0 0 0 0 1 0 0 0 0 1 1\n' * 2)
        self.assertEqual(self.written(), {'drive/04'})
        os.utime(self.folder / 'kitti/dataset/sequences/04/image_0/000000.png', (1, 4e9))
        self.assertEqual(self.written(), {'drive/04'})


class Fitting(support.FolderTest):
    def test_test_sequences_take_no_part_in_the_fit_of_the_objects_line(self):
        self.fake_program('plumb-train', f'echo "$@" > {self.folder}/called; touch {self.folder}/fit/fit.part.json')
        drives = {f'tracking_{n:04d}': {'kind': 'tracking', 'number': f'{n:04d}'} for n in (8, 9)}
        drives['04'] = {'kind': 'odometry', 'number': '04'}
        self.write('plan.json', json.dumps({'bin': str(self.folder / 'bin'), 'drives': drives}))
        for name in drives:
            self.write(f'fit/boxes/{name}.csv', training_jobs.NO_BOXES + ('0,1,2,3\n' if name != '04' else ''))
        training_jobs.fit(jobs.Job(self.folder))
        called = (self.folder / 'called').read_text()
        self.assertIn('boxes/tracking_0008.csv', called)
        self.assertNotIn('tracking_0009', called)
        self.assertNotIn('boxes/04.csv', called)


class Plan(KittiTree):
    def make(self, trials):
        options = types.SimpleNamespace(trials=trials, modes=['paper', 'default'], bin=self.folder, detector=None)
        usable = [self.plain(name) for name, drive in self.drives.items() if not drive.lacks]
        return plan.make(usable, [], options, {}, {})

    def test_takes_the_camera_from_each_calibration(self):
        drives = self.make(0)['drives']
        self.assertEqual(drives['04']['camera_facts']['height_m'], 1.7)
        self.assertEqual(drives['tracking_0003']['camera_facts']['height_m'], 1.65)
        self.assertNotEqual(drives['04']['rig'], drives['tracking_0003']['rig'])

    def test_trials_differ_and_are_the_same_again(self):
        trials = self.make(4)['trials']['04']
        self.assertEqual(trials[0], {'skip': 0, 'noise': 0.0, 'drop': 0.0, 'seed': 1})
        self.assertEqual(len({json.dumps(trial) for trial in trials}), 5)
        self.assertEqual(trials, self.make(4)['trials']['04'])
        self.assertEqual(trials, self.make(9)['trials']['04'][:5])

    def test_the_file_stays_untouched_when_nothing_changed(self):
        path = self.folder / 'plan.json'
        plan.write(self.make(2), path)
        before = path.stat().st_mtime_ns
        plan.write(self.make(2), path)
        self.assertEqual(path.stat().st_mtime_ns, before)


class Failures(support.FolderTest):
    LOG = ('job: plumb-replay failed with 2: no such log\nError in rule run:\n    jobid: 1\n    output: runs/04/result.json\n'
           'job: late\nError in rule log:\n    output: logs/05.lcm\n')

    def test_names_jobs_that_left_nothing(self):
        self.write('workflow.log', self.LOG)
        self.write('logs/05.lcm', 'made by the second attempt')
        self.assertEqual(driver.failed_jobs(self.folder),
                         {'runs/04/result.json': 'plumb-replay failed with 2: no such log'})

    def test_one_folder_has_one_master(self):
        with driver.lock(self.folder):
            with self.assertRaisesRegex(UsageError, 'in use by another plumb-kitti'):
                driver.lock(self.folder)


if __name__ == '__main__':
    unittest.main()
