"""Says what to download for the figures and tables that the data at hand cannot fill."""

SIZES = 'see www.cvlibs.net/datasets/kitti'
TRAINING_SEQUENCES = [f'{n:02d}' for n in range(11)]
SERVER_SEQUENCES = [f'{n:02d}' for n in range(11, 22)]
TABLE_3_DRIVES = ('2011_09_29_drive_0004', '2011_09_26_drive_0056', '2011_10_03_drive_0047')


def sequences_lacking(drives, wanted, has):
    """Those of the wanted sequences for which no drive fulfils `has`."""
    there = {drive['number'] for drive in drives if drive['kind'] == 'odometry' and has(drive)}
    return [number for number in wanted if number not in there]


def row(section, what, download):
    return {'section': section, 'what': what, 'download': download}


def odometry_rows(drives):
    rows = []
    lacking = sequences_lacking(drives, TRAINING_SEQUENCES, lambda drive: True)
    if lacking:
        rows.append(row('Table 1, Figs 1, 9, 10', 'images of sequences ' + ', '.join(lacking),
                        'data_odometry_gray.zip, data_odometry_calib.zip'))
    untrue = [number for number in TRAINING_SEQUENCES if number not in lacking and number in
              sequences_lacking(drives, TRAINING_SEQUENCES, lambda drive: drive['poses'])]
    if untrue:
        rows.append(row('Table 1, Figs 1, 9, 10', 'true poses of sequences ' + ', '.join(untrue),
                        'data_odometry_poses.zip'))
    unscanned = sequences_lacking(drives, TRAINING_SEQUENCES, lambda drive: drive['velodyne'] or drive['planes'])
    if unscanned:
        rows.append(row('Figs 3 to 10: true planes', 'scans of sequences ' + ', '.join(unscanned),
                        'data_odometry_velodyne.zip'))
    server = sequences_lacking(drives, SERVER_SEQUENCES, lambda drive: True)
    if server:
        rows.append(row('Fig. 11, benchmark server', 'images of sequences ' + ', '.join(server),
                        'data_odometry_gray.zip, data_odometry_calib.zip'))
    return rows


def tracking_rows(drives, label_folders):
    there = {drive['number'] for drive in drives if drive['kind'] == 'tracking' and '/training' in drive['folder']}
    lacking = [f'{n:04d}' for n in range(21) if f'{n:04d}' not in there]
    rows = []
    if lacking:
        rows.append(row('Fig. 12', 'images of tracking sequences ' + ', '.join(lacking),
                        'data_tracking_image_2.zip, data_tracking_calib.zip, data_tracking_oxts.zip'))
    if not label_folders:
        rows.append(row('Fig. 12', 'labels of the tracking sequences', 'data_tracking_label_2.zip'))
    return rows


def rows_of(drives, label_folders, others):
    """[{'section', 'what', 'download'}]. `drives` are plain dictionaries."""
    rows = odometry_rows(drives) + tracking_rows(drives, label_folders)
    raw = {drive['name'] for drive in drives if drive['kind'] == 'raw' and
           (drive['labels'] or drive['tracklets'])}
    for name in TABLE_3_DRIVES:
        if name not in raw:
            rows.append(row('Table 3', f'{name} with its tracklets',
                            f'{name}_sync.zip, {name}_tracklets.zip, {name[:10]}_calib.zip'))
    if not others:
        rows.append(row('Fig. 11, Table 1', "other systems' trajectories (--others NAME=FOLDER)",
                        'from their authors, one KITTI text file per sequence'))
    if not any(drive['kind'] == 'folder' for drive in drives):
        rows.append(row('Table 2', 'the sequences of The Hague, each as a folder of images with camera.toml and map.toml',
                        'not on a public server: from the authors of the data set'))
    for drive in drives:
        rows += [row(drive['name'], text.partition(' (')[0], text.partition('(')[2].rstrip(')'))
                 for text in drive['lacks']]
    return rows
