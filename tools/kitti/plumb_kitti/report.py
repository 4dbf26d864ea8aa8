"""Puts the results into report.html, and the data of the page into report.json. The same results give the same bytes."""
from plumb_kitti import jobs, objects, page, sections, training
from plumb_kitti.results import Results
from plumb_tools.figures import cell


def headline(results):
    """The figures on top: (what, value, beside it)."""
    drives = results.with_truth()
    found = []
    for kind, title in (('long', '100 to 800 m'), ('short', '10, 20, 50 m')):
        errors = results.errors(drives, 'default', kind)
        if errors:
            paper = results.errors(drives, 'paper', kind)
            found.append({'what': f'translation, {title}', 'value': cell(errors[0]) + ' %',
                          'beside': f'published method {cell(paper[0])} %' if paper else ''})
    mean = results.pooled_height(drives, 'default')
    if mean is not None:
        found.append({'what': 'height by the true step', 'value': cell(mean) + ' %',
                      'beside': f"published method {cell(results.pooled_height(drives, 'adaptive'))} %"})
    lidar = [d for d in drives if results.true_planes(d)]
    if lidar:
        found.append({'what': 'the same where planes are measured',
                      'value': cell(results.pooled_height(lidar, 'default')) + ' %',
                      'beside': f"a constant {cell(results.pooled_height(lidar, 'constant'))} %"})
    return found


def report(job, failed=None):
    results = Results(job.out, job.plan)
    data = {'title': 'Plumbline on KITTI', 'headline': headline(results), 'sections': [
        sections.data_section(results), sections.table_1(results), sections.figure_1(results), sections.figure_9(results),
        sections.figure_10(results), sections.plane_section(results), training.training(results), sections.figure_11(results),
        objects.figure_12(results), objects.tables_2_and_3(results), sections.runs_section(results, failed or {})]}
    part = job.out / 'report.part'
    part.write_text(page.html_of(data, job.out / 'page'))
    part.replace(job.out / 'report.html')
    if not failed:  # the workflow takes this file for the end of its work
        jobs.write_json(job.out / 'report.json', data)
