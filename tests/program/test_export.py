"""`gnbv export`: what other programs read, parsed here anew, agrees with the run's own frames,
pixel by pixel; the real COLMAP triangulates our images onto the true surface."""
import csv
import re
import shutil
import sqlite3
import subprocess
import types

import pytest
from program import json_of

np = pytest.importorskip('numpy')
Image = pytest.importorskip('PIL.Image')

CALM = '--set', 'planner.fvs.mode=single'  # between whose views the vehicle turns little
LARGE = ('--set', 'cameras.0.width_px=640', '--set', 'cameras.0.height_px=480', '--set',
         'planner.termination.max_iterations=20',  # images with features, as large as the paper's
         '--set', 'planner.fvs.enabled=false')  # and with much in common


def pose(numbers):
    """4 x 4, of x y z qx qy qz qw."""
    x, y, z, qx, qy, qz, qw = map(float, numbers)
    cross = np.array([[0, -qz, qy], [qz, 0, -qx], [-qy, qx, 0]])
    T = np.eye(4)
    T[:3, :3] += 2 * qw * cross + 2 * cross @ cross
    T[:3, 3] = x, y, z
    return T


def placed(T, points):
    return points @ T[:3, :3].T + T[:3, 3]


def is_near(T, expected):
    return np.allclose(T, expected, rtol=0, atol=2e-6)


def rows_of(path):
    lines = path.read_text().splitlines()
    return [line.split(' ') for line in lines if not line.startswith('#')]


def colour_of(path):
    return np.asarray(Image.open(path).convert('RGB'))


def depth_mm_of(path):
    return np.asarray(Image.open(path)).astype(int)


def colmap_of(model):
    """k: fx fy cx cy; of each image T_camera_world and `seen`, rows of x, y, number of a point; of
    each point by its number p_world_m, rgb and `track`, rows of image, index into its `seen`."""
    camera = rows_of(model / 'cameras.txt')[0]
    assert camera[1] == 'PINHOLE'
    lines = rows_of(model / 'images.txt')
    images = [types.SimpleNamespace(
        number=int(head[0]), T_camera_world=pose([*head[5:8], *head[2:5], head[1]]),
        seen=np.array([float(cell) for cell in points if cell]).reshape(-1, 3))
        for head, points in zip(lines[::2], lines[1::2], strict=True)]
    points = {int(row[0]): types.SimpleNamespace(
        p_world_m=np.array(row[1:4], float), rgb=np.array(row[4:7], int),
        track=np.array(row[8:], int).reshape(-1, 2)) for row in rows_of(model / 'points3D.txt')}
    return types.SimpleNamespace(k=np.array(camera[4:8], float), images=images, points=points)


def pixels_of(k, points):
    return k[:2] * points[:, :2] / points[:, 2:] + k[2:]


@pytest.fixture
def flown(whole):
    return whole('run', 'smoke', '--quiet', '--frames', *CALM, '--out').path


@pytest.fixture
def exported(whole, flown):
    """exported(format) -> the folder, of which nothing had to be said."""
    def made(name):
        done = whole('export', str(flown), '--quiet', '--format', name, '-o')
        assert (done.end.out, done.end.err) == (f'{done.path}\n', '')
        return done.path

    return made


@pytest.fixture
def model(exported):
    return colmap_of(exported('colmap') / 'sparse/0')


@pytest.fixture
def frames(flown):
    """The run's own: T_world_camera, colour, depth_mm."""
    with (flown / 'frames/poses.csv').open() as file:
        rows = [list(row.values()) for row in csv.DictReader(file)]
    return [types.SimpleNamespace(T=pose(row[3:10]), colour=colour_of(flown / 'frames' / row[10]),
                                  depth_mm=depth_mm_of(flown / 'frames' / row[11]))
            for row in rows]


def test_colmap_points_project_where_the_images_show_them(model, frames):
    assert len(model.points) > 500
    assert [image.number for image in model.images] == list(range(1, len(frames) + 1))
    off_m = []
    for image, frame in zip(model.images, frames, strict=True):
        assert is_near(image.T_camera_world @ frame.T, np.eye(4))
        world_m = [model.points[int(number)].p_world_m for number in image.seen[:, 2]]
        p_m = placed(image.T_camera_world, np.array(world_m).reshape(-1, 3))
        at_px = pixels_of(model.k, p_m)
        assert np.abs(at_px - image.seen[:, :2]).max(initial=0) < 0.01
        u, v = at_px.astype(int).T
        off_m.extend(np.abs(0.001 * frame.depth_mm[v, u] - p_m[:, 2]))
    # half a leaf, and half a pixel of a steep surface; most are on the surface to some millimetres
    assert max(off_m) < 0.025 + 0.5 * 5.0 / model.k[0] * 5.7 + 0.001
    assert np.median(off_m) < 0.008


def test_colmap_tracks_and_colours_are_those_of_the_images(model, frames):
    strange = 0
    for number, point in model.points.items():
        assert len(point.track) >= 2
        seen = []  # how far away, and whether in that colour
        for at, index in point.track:
            image = model.images[at - 1]
            assert image.seen[index, 2] == number
            p_m = placed(image.T_camera_world, point.p_world_m[None])
            (u, v), = pixels_of(model.k, p_m).astype(int)
            seen.append((p_m[0, 2], (frames[at - 1].colour[v, u] == point.rgb).all()))
        # from one place, two frames are as near as each other: rounding may choose
        nearest_m = min(z_m for z_m, _ in seen)
        strange += not any(is_it for z_m, is_it in seen if z_m < nearest_m + 1e-6)
    assert sum(len(point.track) for point in model.points.values()) == sum(
        len(image.seen) for image in model.images)
    assert 1000 * strange <= len(model.points), 'on the border of two pixels rounding chooses, too'


def corners_of(obj):
    """Triangles x 3 x 3: of its polygons, which are convex, and of the ground."""
    lines = [line.split() for line in obj.read_text().splitlines() if line]
    vertices = np.array([line[1:4] for line in lines if line[0] == 'v'], float)
    faces = [[int(corner.split('/')[0]) - 1 for corner in line[1:]]
             for line in lines if line[0] == 'f']
    fans = [(face[0], face[i], face[i + 1]) for face in faces for i in range(1, len(face) - 1)]
    ground = [[[-99, -99, 0], [99, -99, 0], [0, 99, 0]]]
    return np.concatenate([vertices[np.array(fans)], np.array(ground, float)])


def first_hits(triangles, origin, rays):
    """How many times its length each ray goes until it hits (Moeller and Trumbore 1997)."""
    nearest = np.full(len(rays), np.inf)
    for a, b, c in triangles:
        normal = np.cross(rays, c - a)
        with np.errstate(divide='ignore', invalid='ignore'):
            u = normal @ (origin - a) / (normal @ (b - a))
            v = rays @ np.cross(origin - a, b - a) / (normal @ (b - a))
            t = (c - a) @ np.cross(origin - a, b - a) / (normal @ (b - a))
            nearest = np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0), np.minimum(nearest, t),
                               nearest)
    return nearest


def test_pixel_centres_lie_at_half_pixels(run, tmp_path, model, frames):
    """The true structure, seen through the centres of the pixels as COLMAP numbers them."""
    run('asset smoke -o smoke.obj')
    triangles = corners_of(tmp_path / 'smoke.obj')
    for frame in frames[::4]:
        v, u = np.nonzero(frame.depth_mm)
        for centre_px, is_it in ((0.5, True), (0.0, False), (1.0, False)):
            at = (np.stack([u, v], 1) + centre_px - model.k[2:]) / model.k[:2]
            rays = np.column_stack([at, np.ones(len(at))]) @ frame.T[:3, :3].T
            off_m = first_hits(triangles, frame.T[:3, 3], rays) - 0.001 * frame.depth_mm[v, u]
            share = np.mean(np.abs(off_m) < 0.001)
            assert share > 0.99 if is_it else share < 0.9


def test_nerfstudio_poses_are_ours(exported, model, frames):
    out = exported('nerfstudio')
    json = json_of(out / 'transforms.json')
    for ours, frame in zip(json['frames'], frames, strict=True):
        y_up_z_back = np.diag([1.0, -1.0, -1.0, 1.0])
        assert is_near(np.array(ours['transform_matrix']) @ y_up_z_back, frame.T)
        assert ours['fl_y'] == model.k[1]
        assert (depth_mm_of(out / ours['depth_file_path']) == frame.depth_mm).all()
        assert (colour_of(out / ours['file_path']) == frame.colour).all()
    assert json['depth_unit_scale_factor'] == 0.001
    assert (out / json['ply_file_path']).exists()


def test_tum_truth_and_estimate_agree(exported, frames):
    """Without errors of the estimate, what was believed is what was."""
    out = exported('tum') / 'rgbd'
    truth = {row[0]: pose(row[1:]) for row in rows_of(out / 'groundtruth.txt')}
    times_s = [float(time) for time in truth]
    assert (np.diff(times_s) > 0).all()
    rows = rows_of(out / 'estimate.txt')
    assert times_s[-1] == float(rows[-1][0])
    pairs = rows_of(out / 'associations.txt')
    for row, pair, frame in zip(rows, pairs, frames, strict=True):
        off = np.linalg.inv(truth[row[0]]) @ pose(row[1:])
        assert np.linalg.norm(off[:3, 3]) < 0.003
        assert np.arccos(np.clip((np.trace(off) - 2) / 2, -1, 1)) < np.radians(1)
        assert is_near(pose(row[1:]), frame.T)
        assert (colour_of(out / pair[1]) == frame.colour).all()
        assert (depth_mm_of(out / pair[3]) == 5 * frame.depth_mm).all(), '5000 steps a metre'


def test_tum_depth_has_the_steps_that_are_asked_for(run, flown, tmp_path, frames):
    for factor, depth_of in ((1000, lambda mm: mm), (20000, lambda mm: 20 * mm * (mm < 3277))):
        end = run(f'export {flown} --format tum --depth-factor {factor} -o asked{factor}')
        assert ('deeper than 3.3 m' in end.err) == (factor == 20000)
        out = tmp_path / f'asked{factor}/rgbd'
        for pair, frame in zip(rows_of(out / 'associations.txt'), frames, strict=True):
            assert (depth_mm_of(out / pair[3]) == depth_of(frame.depth_mm)).all()
    for words in ('--format tum --depth-factor 0', '--format plain --depth-factor 5000'):
        run(f'export {flown} {words}', code=2)


def test_plain_files_hold_body_and_camera(exported, flown, frames):
    out = exported('plain')
    T_body_camera = np.array(json_of(out / 'intrinsics.json')['cameras'][0]['T_body_camera'])
    with (out / 'views.csv').open() as file:
        rows = list(csv.reader(file))[1:]
    for row, frame in zip(rows, frames, strict=True):
        assert is_near(pose(row[3:10]) @ T_body_camera, pose(row[10:17]))
        assert is_near(pose(row[10:17]), frame.T)
    # each point of the cloud with its colour and the view that brought it
    head, body = (out / 'cloud.ply').read_bytes().split(b'property int view\nend_header\n', 1)
    views = np.frombuffer(body, [('xyz', '<f4', 3), ('rgb', 'u1', 3), ('view', '<i4')])['view']
    profile = (flown / 'profile.ply').read_bytes().split(b'end_header')[0]
    before = int(re.search(rb'element vertex (\d+)', profile)[1])
    with (flown / 'iterations.csv').open() as file:
        ends = [int(row['cloud_points']) for row in csv.DictReader(file)]
    expected = np.repeat(np.arange(-1, len(ends)), np.diff([0, before, *ends]))
    assert (views == expected).all()
    readme = (out / 'README.txt').read_text()
    names = {path.name for path in out.iterdir()} - {'README.txt', 'gnbv-export.json'}
    assert all(name in readme for name in names)


@pytest.mark.parametrize('words', [['--frames', '--set', 'cameras.0.drop_probability=1'],
                                   ['--set', 'cameras=[]']])
def test_a_run_whose_views_have_no_frames_is_exported_without(whole, run, tmp_path, words):
    flown = whole('run', 'smoke', '--quiet', *words, '--set', 'planner.termination.max_iterations=3',
                  '--out').path
    run(f'export {flown} --format colmap', 'there are no frames', code=2)
    for name in ('tum', 'plain'):
        end = run(f'export {flown} --format {name} -o {name}')
        assert 'there are no frames' in end.err and '--frames' not in end.err, 'none would keep them'
    rows = (tmp_path / 'plain/views.csv').read_text().splitlines()
    assert len(rows) == 4 and len({row.count(',') for row in rows}) == 1


@pytest.mark.skipif(shutil.which('colmap') is None, reason='colmap is not installed')
def test_colmap_triangulates_our_images_onto_the_true_surface(run, whole, tmp_path, monkeypatch):
    monkeypatch.setenv('QT_QPA_PLATFORM', 'offscreen')
    flown = whole('run', 'smoke', '--quiet', '--frames', *LARGE, '--out').path
    run(f'export {flown} --quiet --format colmap -o model')
    sparse, found = tmp_path / 'model/sparse/0', tmp_path / 'found'
    found.mkdir()

    def colmap(words):
        done = subprocess.run(['colmap', *words.split()], cwd=tmp_path, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        assert done.returncode == 0, f'{words}\n{done.stdout}'
        return done.stdout

    ours = colmap_of(sparse)
    report = colmap(f'model_analyzer --path {sparse}')
    figures = {name: float(value) for name, value in re.findall(r'([A-Z][\w ]+): ([\d.]+)', report)}
    assert figures['Registered images'] == len(ours.images)
    assert figures['Points'] == len(ours.points)
    assert figures['Mean track length'] > 2 and figures['Mean reprojection error'] < 0.5
    files = '--database_path d.db --image_path model/images'
    colmap('feature_extractor --SiftExtraction.use_gpu 0 --ImageReader.camera_model PINHOLE '
           '--ImageReader.single_camera 1 --image_list_path model/cameras/1.txt '
           '--ImageReader.camera_params '
           f'{",".join(map(str, ours.k))} {files}')
    colmap('exhaustive_matcher --SiftMatching.use_gpu 0 --database_path d.db')
    # COLMAP 3.10 ends by a signal where the model has an image that matches none
    with sqlite3.connect(tmp_path / 'd.db') as database:
        matched = {image for pair, in database.execute(
            'SELECT pair_id FROM two_view_geometries WHERE rows >= 15')
            for image in divmod(pair, 2**31 - 1)}
        unmatched = [name for image, name in database.execute('SELECT image_id, name FROM images')
                     if image not in matched]
    (tmp_path / 'unmatched.txt').write_text(''.join(name + '\n' for name in unmatched))
    (tmp_path / 'matched').mkdir()
    colmap(f'image_deleter --input_path {sparse} --output_path matched '
           '--image_names_path unmatched.txt')
    colmap('point_triangulator --clear_points 1 --Mapper.ba_refine_focal_length 0 '
           '--Mapper.filter_max_reproj_error 2 --Mapper.filter_min_tri_angle 5 '
           f'--Mapper.tri_min_angle 5 --input_path matched --output_path found {files}')
    colmap('model_converter --output_type TXT --input_path found --output_path found')
    points = list(colmap_of(found).points.values())

    def within(distance_m, some):
        """Their share that lies so near the true surface, the ground and what is beyond left out."""
        some = [p.p_world_m for p in some if (np.abs(p.p_world_m) < [4, 4, 5]).all()]
        np.savetxt(tmp_path / 'points.xyz', some)
        at = run('score points.xyz --scenario smoke --json').json['precision_recall']
        return next(d['precision'] for d in at if d['distance_m'] == distance_m)

    # two images can agree on two different bricks of one row; a third seldom joins them
    sure = [point for point in points if len(point.track) > 2]
    assert len(sure) > 60
    assert within(0.05, points) > 0.5 and within(0.02, sure) > 0.5 and within(0.05, sure) > 0.85


def test_skew_is_refused_by_what_cannot_say_it(whole, run):
    flown = whole('run', 'smoke', '--quiet', '--frames', '--set', 'cameras.0.skew_px=2', '--set',
                  'planner.termination.max_iterations=1', '--out').path
    for format_ in ('colmap', 'nerfstudio'):
        run(f'export {flown} --format {format_} -o {format_}', 'has no camera with skew_px = 2',
            code=2)
