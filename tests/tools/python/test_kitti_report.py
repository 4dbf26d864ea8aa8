"""Tests the report of tools/kitti/plumb-kitti: its page and its sections."""
import json
import math
import sys
import unittest

import support

sys.path.insert(0, str(support.ROOT / 'tools/kitti'))
from plumb_kitti import blocks, objects, page, sections, training
from plumb_kitti.results import Results


class Page(support.FolderTest):
    def html(self, blocks_, script='draw()'):
        self.write('page/bundle.js', script)
        data = {'title': 'T', 'headline': [], 'sections': [sections.section('a', 'A <b>', blocks_, 'p')]}
        return page.html_of(data, self.folder / 'page')

    def test_is_one_file_and_escapes(self):
        chart = blocks.lines('c', 'x', 'y', [blocks.curve('</script>', [(0, 1), (1, float('nan'))])])
        text = self.html([chart, blocks.table(['h'], [['<i>']])])
        self.assertIn('A &lt;b&gt;', text)
        self.assertIn('<td>&lt;i&gt;</td>', text)
        self.assertEqual(text.count('</script>'), 2)
        self.assertIn('[1.0,null]', text)
        self.assertNotRegex(text, r'(src|href)="(https?:|/)')

    def test_an_empty_section_says_that_its_data_is_missing(self):
        self.assertIn('Data not here', self.html([blocks.note('why')]))
        self.assertNotIn('Data not here', self.html([blocks.table(['h'], [['1']])]))

    def test_without_npm_it_says_that_it_has_no_charts(self):
        self.assertIn('npm was not here', self.html([blocks.bars('c', 'y', [('04', 'default', 1.5)])], script=''))
        self.assertIn('<td>1.50</td>', self.html([blocks.bars('c', 'y', [('04', 'default', 1.5)])], script=''))

    def test_curves_are_thinned_to_what_a_screen_shows(self):
        curve = blocks.curve('default', [(k, k) for k in range(10001)])
        self.assertLessEqual(len(curve['x']), blocks.MOST_POINTS + 1)
        self.assertEqual((curve['x'][0], curve['x'][-1]), (0, 10000))


class Sections(support.FolderTest):
    """Two measured drives, as the jobs leave them."""

    def setUp(self):
        super().setUp()
        drives = {name: {'name': name, 'kind': 'odometry', 'number': name, 'num_images': 50, 'poses': 'p', 'oxts': '',
                         'planes': '', 'velodyne': '', 'map': '', 'rig': 'r', 'camera_facts': {'fx_px': 1.0, 'height_m': 1.65}}
                  for name in ('04', '05')}
        self.plan = {'drives': drives, 'modes': ['default', 'paper', 'paper-fixed'], 'boxes': {}, 'others': {}, 'planes': [],
                     'trials': {'04': [{}, {}], '05': [{}, {}]}, 'missing': []}
        for k, name in enumerate(drives):
            for mode in self.plan['modes']:
                for trial in range(2):
                    self.write_run(name, mode, trial, t=1.0 + trial, num=1 + 2 * k)

    def write_run(self, name, mode, trial, t, num):
        errors = {'num_segments': num, 't_percent': t + num, 'r_deg_m': 0.01, 'by_speed': [],
                  'by_length': [{'length_m': 10.0, 'num_segments': num, 't_percent': t, 'r_deg_m': 0.01}]}
        height = {kind: {'num_frames': 10 * num, 'mean_percent': float(num), 'bias_percent': 0.0,
                         'within_7_percent_ratio': 1.0} for kind in ('fused', 'dense', 'points', 'constant')}
        folder = f'runs/{name}/{mode}/{trial}'
        self.write(f'{folder}/result.json', json.dumps({
            'num_frames': 50, 'ego_status': {'ok': 50}, 'path_m': 60.0, 'short': errors,
            'long': {**errors, 'num_segments': 0, 'by_length': []}, 'height': height}))
        self.write(f'{folder}/height.json', json.dumps({k: {'frames': [1, 2], 'errors_percent': [1.0, -1.0]} for k in height}))
        for file in ('truth.txt', 'poses.txt'):
            self.write(f'{folder}/{file}', '1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n')

    def cells(self, section):
        return [row for block in section['blocks'] if block['type'] == 'table' for row in block['rows']]

    def test_table_1_has_mean_and_variance_over_trials_and_pools_by_segments(self):
        rows = self.cells(sections.table_1(Results(self.folder, self.plan)))
        self.assertIn(['04', 'default', '10, 20, 50 m', '2', '2.500', '0.5', '0.01000', '0'], rows)
        self.assertIn(['all, pooled', 'default', '10, 20, 50 m', 'undisturbed', '3.500', '', '0.01000', ''], rows)

    def test_figure_10_pools_by_images_and_gives_the_constant_no_credit_without_planes(self):
        rows = {row[0]: row for row in self.cells(sections.figure_10(Results(self.folder, self.plan)))}
        self.assertEqual(rows['adaptive'], ['adaptive', '2.50', '100.0', '-', '-', '3.97'])
        self.assertEqual(rows['constant'][1:5], ['-', '-', '-', '-'])

    def test_a_histogram_has_as_many_errors_in_every_bin_of_the_confidence(self):
        pairs = sorted((math.sin(7.0 * k) + 2.0, abs(math.cos(3.0 * k))) for k in range(400))
        cells = training.histogram(pairs)
        self.assertEqual(sum(cell[4] for cell in cells), 400)
        columns = {}
        for low, _, _, _, number in cells:
            columns[low] = columns.get(low, 0) + number
        self.assertEqual(set(columns.values()), {8})
        self.assertEqual(training.histogram(pairs[:15]), [])

    def test_training_draws_what_the_samples_hold(self):
        self.write('fit/samples/04.csv', '# plumb\npaper_width_height,paper_err_height\n' +
                   ''.join(f'{0.1 + 0.001 * k},{0.01 * (k % 7)}\n' for k in range(90)) + ',0.3\n')
        self.write('fit/fit.json', json.dumps({'paper': [{'name': 'h', 'offset': 0.1, 'slope': 2.0, 'bins': [
            {'confidence': 0.1, 'variance': 0.3}, {'confidence': 0.2, 'variance': 0.5}]}]}))
        charts = [b for b in training.training(Results(self.folder, self.plan))['blocks'] if b['type'] != 'note']
        self.assertEqual([chart['type'] for chart in charts], ['heat', 'lines'])
        self.assertEqual(sum(row['n'] for row in charts[0]['rows']), 90)
        self.assertEqual(charts[1]['curves'][1]['y'], [0.3, 0.5])

    def test_one_image_shows_what_confidences_are_fitted_to(self):
        gaussian = {'centre': 1.6, 'width': 0.1, 'depth': 0.5, 'offset': 0.9}
        box = {'amplitude': 0.8, 'lower_edge_px': 200.0, 'height_px': 50.0, 'lower_edge_var_px2': 4.0, 'height_var_px2': 9.0}
        candidates_ = [{'lower_edge_px': 199.0, 'height_px': 51.0, 'score': 0.7}]
        self.write('fit/example.json', json.dumps({
            'drive': '04', 'seq': 5, 'slices': [{'component': 'h', 'x': [0.8, 2.4], 'cost': [0.9, 0.9], 'gaussian': gaussian},
                                                {'component': 'n1', 'x': [-0.1, 0.1], 'cost': [0.9, 0.9]}],
            'object': {'seq': 6, 'confidence_px2': 2.77, 'gaussian': box, 'candidates': candidates_}}))
        text = json.dumps(training.training(Results(self.folder, self.plan)))
        for words in ('along h, image 5 of 04, width 0.1000', 'along n1, image 5 of 04, which has no dip to fit',
                      'by their lower edge, image 6 of 04; a_d = 2.77', 'by their height of the box'):
            self.assertIn(words, text)
        charts = [b for b in training.training(Results(self.folder, self.plan))['blocks'] if b['type'] == 'lines']
        self.assertAlmostEqual(min(charts[0]['curves'][1]['y']), 0.4)
        self.assertAlmostEqual(max(charts[2]['curves'][1]['y']), 0.8)

    def test_figure_12_pools_training_and_test_sequences_by_objects(self):
        drives = {f'tracking_{n:04d}': {'kind': 'tracking', 'folder': '/x/training', 'number': f'{n:04d}'} for n in (3, 9, 12)}
        self.plan.update(boxes={drive: ['label_02'] for drive in drives}, planes=['paper'], drives=drives)
        self.assertEqual(objects.groups_of(self.plan)['tracking 9 to 20, test'], ['tracking_0009', 'tracking_0012'])
        for number, (samples, error) in {3: (4, 50.0), 9: (1, 10.0), 12: (3, 30.0)}.items():
            figures = {'all': {'num_samples': samples, 'foot_depth_error_percent': error, 'depth_error_percent': error,
                               'position_error_percent': error}}
            self.write(f'placed/tracking_{number:04d}/label_02/paper/result.json',
                       json.dumps({'close': {'all': {'num_samples': 0}}, 'distant': figures}))
        rows = {row[0]: row for row in self.cells(objects.figure_12(Results(self.folder, {**self.plan, 'trials': {
            drive: [] for drive in drives}})))}
        self.assertEqual(rows['tracking 9 to 20, test'][6:], ['4', '25.0', '25.0'])
        self.assertEqual(rows['tracking 0 to 8, training'][6:], ['4', '50.0', '50.0'])

    def test_tables_2_and_3_stand_beside_the_papers_values(self):
        self.plan['drives']['04']['map'] = 'map.toml'
        self.plan['drives']['05']['map'] = ''
        folder = self.folder / 'runs/04/default/0/result.json'
        folder.write_text(json.dumps({**json.loads(folder.read_text()),
                                      'end_point': {'map_length_m': 600.0, 'error_percent': 4.25}}))
        rows = self.cells(objects.tables_2_and_3(Results(self.folder, self.plan)))
        self.assertIn(['04', '50', '600.00', '-', '4.25', '-'], rows)
        self.assertIn(['The Hague 2', '3000', '834.39', '1.99', '', ''], rows)
        entry = {reach: {'all': {'num_samples': n, 'foot_depth_error_percent': e, 'position_error_percent': 2 * e}}
                 for reach, n, e in (('close', 1, 10.0), ('distant', 3, 20.0))}
        for plane in objects.PLANES_OF_TABLE_3:
            self.write(f'placed/2011_09_26_drive_0056/label_02/{plane}/result.json', json.dumps(entry))
        rows = {row[0]: row for row in self.cells(objects.tables_2_and_3(Results(self.folder, self.plan)))}
        self.assertEqual(rows['2011_09_26_drive_0056'][-6:], ['17.5'] * 3 + ['35.0'] * 3)
        self.assertEqual(rows['2011_09_29_drive_0004'][-6:], ['data not here'] * 6)

    def test_every_figure_is_there(self):
        results = Results(self.folder, self.plan)
        for make in (sections.figure_1, sections.figure_9, sections.figure_10, sections.figure_11):
            self.assertTrue(any(b['type'] in ('lines', 'bars') for b in make(results)['blocks']), make.__name__)

    def test_a_comparison_of_few_images_tells_nothing(self):
        entry = {'num_blocks': 3, 'difference': {'mean': -1.0, 'low': -2.0, 'high': -0.5}}
        self.assertEqual(sections.verdict(entry), 'too few images to tell')
        self.assertEqual(sections.verdict({**entry, 'num_blocks': 30}), 'the first is better')
        entry['difference']['high'] = 0.5
        self.assertEqual(sections.verdict({**entry, 'num_blocks': 30}), 'not told apart')


if __name__ == '__main__':
    unittest.main()
