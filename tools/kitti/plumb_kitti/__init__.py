"""The workflow behind tools/kitti/plumb-kitti.

discover finds drives below a folder, staging puts each into a layout that plumb-kitti2lcm reads, jobs are
the steps that the Snakefile calls, and report and page make one page of their results. The numbers
are measured by plumb-eval, plumb-train and the programs beside this folder.
"""
