"""Tests the tables and modes of tools/evaluate/bench_accuracy with made-up reports."""
import argparse
import unittest

import support
from plumb_tools import figures, gnuplot, markup
from plumb_tools.accuracy import pictures, tables
from plumb_tools.accuracy.bench import Bench
from plumb_tools.accuracy.command import parse_modes


class FakeBench:
    """Two drives, one mode, two seeds."""
    drives, modes, seeds, first_seed = {'a': None, 'b': None}, {'default': ''}, [1, 2], 1
    ERRORS = {'a': (1.0, 10), 'b': (4.0, 20)}

    def report(self, _mode, seed, drive, kind):
        t, segments = self.ERRORS[drive]
        if kind == 'plane':
            return None if drive == 'b' else {
                'height_error_mean_percent': seed, 'within_7_percent_ratio': 1.0, 'num_compared': 8, 'num_true': 9,
                'pitch': {'mean_deg': 0.1, 'std_deg': 0.2}}
        return {'pooled': {'t_percent': t + seed, 'r_deg_m': 0.01, 'num_segments': segments if kind == 'short' else 0}}

    def frames(self, *_run):
        row = {'ego_status': 'ok', 'reset_counter': '1', 'vo_us': '2000', 'vo_stages_us': 'klt=1500 decode=500'}
        return [dict(row, ego_status='lost'), dict(row, ego_status='scale_held'), row, dict(row, ego_status='')]


class Tables(unittest.TestCase):
    def test_pool_errors_over_segments_and_average_over_seeds(self):
        _, rows = tables.accuracy(FakeBench())
        self.assertEqual(rows, [['default', '4.50', '0.0100', '0.707', '-', '-', '-']])
        _, rows = tables.accuracy_per_drive(FakeBench())
        self.assertEqual([row[:3] for row in rows], [['a', 'default', '2.50'], ['b', 'default', '5.50']])

    def test_leave_out_drives_without_planes(self):
        _, rows = tables.heights(FakeBench())
        self.assertEqual(rows, [['a', 'default', '1.50', '100.0', '0.10', '0.20', '8 / 9']])

    def test_count_frames_with_motion(self):
        _, rows = tables.success(FakeBench())
        self.assertEqual(rows[0][1:7], ['4', '16', '50.0', '4', '4', '1 / 1'])

    def test_show_times_of_stages(self):
        _, rows = tables.times(FakeBench())
        self.assertIn(['default', 'vo klt', '1.50', '1.50'], rows)

    def test_count_drives_with_sound_variances(self):
        scores = {'default': [{'quantity': 'pitch', 'drive': d, 'score': {'nees': v}} for d, v in
                              (('a', 1.0), ('b', 3.0))]}
        head, rows = tables.calibration(scores)
        self.assertEqual(rows[0][head.index('pitch')], '2.00 (1 of 2)')
        self.assertEqual(rows[0][head.index('roll')], '-')
        _, rows = tables.calibration_per_drive(scores, ['b', 'a'])
        self.assertEqual([row[0] for row in rows], ['a', 'b'])

    def test_relative_heights_use_the_nominal_one_without_truth(self):
        row = {'seq': '3', 'log_scale': '0', 'height_m': '1.65', 'plane_status': 'ok', 'dense_height_vo': '3.3',
               'dense_status': 'used', 'points_height_vo': '1', 'points_status': 'gated'}
        curves = tables.relative_height_errors([row], {}, 1.65)
        self.assertEqual(curves, {'dense': [(3, 100.0)], 'points': [], 'fused': [(3, 0.0)]})
        self.assertEqual(tables.relative_height_errors([row], {4: 1.65}, 1.65)['fused'], [])


class Figures(unittest.TestCase):
    def test_ignore_what_is_not_known(self):
        self.assertEqual(figures.mean([1.0, None, float('nan'), 3.0]), 2.0)
        self.assertIsNone(figures.mean([None]))
        self.assertIsNone(figures.standard_deviation([1.0]))
        self.assertEqual(figures.cell(None), '-')
        self.assertEqual(figures.cell(1.234, 1), '1.2')
        self.assertIsNone(figures.pooled([None, {'num_segments': 0}]))

    def test_quantiles_are_order_statistics(self):
        self.assertEqual(figures.quantile([3, 1, 2], 0.5), 2)
        self.assertEqual(figures.quantile([3, 1, 2], 1.0), 3)


class Pictures(unittest.TestCase):
    def test_a_path_is_seen_in_the_first_cameras_frame(self):
        turned = [0, 0, 1, 5, 0, 1, 0, 0, -1, 0, 0, 7]  # looks along x of the world
        moved = list(turned)
        moved[3] = 8
        self.assertEqual(pictures.top_view([turned, moved]), [(0, 0), (0, 3)])

    def test_gnuplot_gets_titles_in_quotes(self):
        text = gnuplot.script('a.png', "the camera's", 'x', 'y', [gnuplot.Curve('c', [(1, 2.5)], dots=True)], True)
        self.assertIn("set title 'the camera''s'", text)
        self.assertIn('$c0 << EOD\n1 2.5\nEOD', text)
        self.assertIn('set size ratio -1', text)

    def test_tables_escape_for_html(self):
        self.assertIn('<td>a &lt; b</td>', markup.html_table(['h'], [['a < b']]))
        self.assertEqual(markup.markdown_table(['h', 'i'], [['1', '2']]), ['| h | i |', '|---|---|', '| 1 | 2 |'])


class Modes(support.FolderTest):
    def test_are_known_names_or_files(self):
        own = self.write('own.toml', '[vo]\n')
        self.assertEqual(parse_modes(f'default,mine={own}'), {'default': '', 'mine': '[vo]\n'})
        with self.assertRaisesRegex(argparse.ArgumentTypeError, 'did you mean fixed?'):
            parse_modes('fixd')

    def test_that_change_are_written_again(self):
        for text in ('', '[vo]\n'):
            Bench(None, self.folder, {}, {'mine': text}, 1)
            self.assertEqual((self.folder / 'config/mine.toml').read_text(), text)


if __name__ == '__main__':
    unittest.main()
