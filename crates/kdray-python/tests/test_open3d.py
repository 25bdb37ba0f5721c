"""kdray.open3d: Open3D's interface, in numpy's arrays."""

import numpy as np
import pytest
from conftest import CUBE_FACES, CUBE_VERTICES, random_rays, sphere

import kdray
from kdray.open3d import RaycastingScene

NONE = RaycastingScene.INVALID_ID

SHEETS = np.array([[0, 0, 2], [2, 0, 2], [0, 2, 2], [0, 0, 4], [2, 0, 4], [0, 2, 4]], np.float32)
"""Two triangles, one behind the other; what Open3D 0.20 says of them stands in the tests."""

RAYS = np.array([[[0.25, 0.5, 0, 0, 0, 2], [9, 9, 0, 0, 0, 1]]], np.float32)


@pytest.fixture
def sheets():
    scene = RaycastingScene()
    assert scene.add_triangles(SHEETS, np.array([[0, 1, 2], [3, 5, 4]], np.uint32)) == 0
    return scene


@pytest.fixture(scope="module")
def ball():
    scene = RaycastingScene(nthreads=1)
    scene.add_triangles(*sphere(20))
    return scene


def test_cast_rays(sheets):
    found = sheets.cast_rays(RAYS)
    assert found["t_hit"].tolist() == [[1, np.inf]]
    assert found["geometry_ids"].tolist() == found["primitive_ids"].tolist() == [[0, NONE]]
    assert found["primitive_uvs"].tolist() == [[[0.125, 0.25], [0, 0]]]
    assert found["primitive_normals"].tolist() == [[[0, 0, 1], [0, 0, 0]]]
    types = {name: array.dtype for name, array in found.items()}
    assert {types.pop("geometry_ids"), types.pop("primitive_ids")} == {np.dtype(np.uint32)}
    assert set(types.values()) == {np.dtype(np.float32)}
    assert sheets.cast_rays(RAYS.astype(np.float64))["t_hit"].dtype == np.float64


def test_list_intersections(sheets):
    found = sheets.list_intersections(RAYS)
    assert found["ray_splits"].dtype == found["ray_ids"].dtype == np.uint32
    assert found["ray_splits"].tolist() == [0, 2, 2]
    assert found["ray_ids"].tolist() == [0, 0]
    assert found["t_hit"].tolist() == [1, 2]
    assert found["geometry_ids"].tolist() == [0, 0]
    assert found["primitive_ids"].tolist() == [0, 1]
    assert found["primitive_uvs"].tolist() == [[0.125, 0.25], [0.25, 0.125]]


def test_count_and_occlusion(sheets):
    assert sheets.count_intersections(RAYS).tolist() == [[2, 0]]
    assert sheets.test_occlusions(RAYS).tolist() == [[True, False]]
    assert sheets.test_occlusions(RAYS, tnear=2.5).tolist() == [[False, False]]
    assert sheets.test_occlusions(RAYS, 0.0, 0.5).tolist() == [[False, False]]


def test_closest_points(sheets):
    found = sheets.compute_closest_points(RAYS[..., :3])
    assert found["points"].tolist() == [[[0.25, 0.5, 2], [1, 1, 2]]]
    assert found["primitive_ids"].tolist() == found["geometry_ids"].tolist() == [[0, 0]]
    assert found["primitive_uvs"].tolist() == [[[0.125, 0.25], [0.5, 0.5]]]
    assert found["primitive_normals"].tolist() == [[[0, 0, 1], [0, 0, 1]]]
    np.testing.assert_allclose(sheets.compute_distance(RAYS[..., :3]), [[2, 11.489125]], rtol=1e-6)


def test_inside_and_outside(ball):
    points = np.random.default_rng(0).uniform(-1.2, 1.2, (1000, 3)).astype(np.float32)
    distance, signed = ball.compute_distance(points), ball.compute_signed_distance(points)
    np.testing.assert_array_equal(np.abs(signed), distance)
    occupancy = ball.compute_occupancy(points, nsamples=3)
    assert occupancy.dtype == np.float32
    np.testing.assert_array_equal(occupancy, (signed <= 0).astype(np.float32))
    radius = np.linalg.norm(points, axis=1)
    assert occupancy[radius < 0.85].all() and not occupancy[radius > 1].any()


def test_points_that_are_none_are_nowhere(ball):
    nowhere = np.float32([[np.nan, 0, 0]])
    assert ball.compute_occupancy(nowhere).tolist() == [0]
    assert not np.isfinite(ball.compute_distance(nowhere)).any()
    assert not np.isfinite(ball.compute_signed_distance(nowhere)).any()


def test_answers_are_those_of_a_scene(ball):
    rays = random_rays(2000, np.float32)
    scene = kdray.Scene(*sphere(20))
    np.testing.assert_array_equal(ball.cast_rays(rays)["t_hit"], scene.closest_hit(rays).t)
    np.testing.assert_array_equal(ball.list_intersections(rays)["t_hit"], scene.all_hits(rays).t)


def test_meshes_are_added_before_and_after_queries(sheets):
    assert sheets.cast_rays(RAYS)["geometry_ids"][0, 0] == 0
    assert sheets.add_triangles(SHEETS - np.float32([0, 0, 1]), [[0, 1, 2]]) == 1
    found = sheets.cast_rays(RAYS)
    assert found["geometry_ids"][0, 0] == 1 and found["t_hit"][0, 0] == 0.5
    assert sheets.count_intersections(RAYS)[0, 0] == 3


def test_an_empty_scene_is_missed():
    found = RaycastingScene().cast_rays(RAYS)
    assert np.isinf(found["t_hit"]).all() and (found["geometry_ids"] == NONE).all()


class Tensor:
    """What kdray knows of a tensor of Open3D."""

    def __init__(self, array):
        self.array = np.asarray(array)

    def numpy(self):
        return self.array


def test_tensors_and_meshes_are_taken(sheets):
    assert sheets.count_intersections(Tensor(RAYS)).tolist() == [[2, 0]]

    class Mesh:
        vertex = type("Vertex", (), {"positions": Tensor(CUBE_VERTICES)})
        triangle = type("Triangle", (), {"indices": Tensor(CUBE_FACES)})

    scene = RaycastingScene()
    assert scene.add_triangles(mesh=Mesh()) == 0
    assert RaycastingScene().add_triangles(Mesh()) == 0
    assert scene.compute_occupancy(Tensor(np.float32([[0.5, 0.5, 0.5]]))).tolist() == [1]
    assert scene.add_triangles(Tensor(CUBE_VERTICES), Tensor(CUBE_FACES.astype(np.uint32))) == 1


def test_rays_of_a_pinhole_camera_by_matrices():
    intrinsic = np.array([[3, 0, 1.5], [0, 3, 1], [0, 0, 1]])
    extrinsic = np.eye(4)
    extrinsic[:3, 3] = [1, 2, 3]
    rays = RaycastingScene.create_rays_pinhole(intrinsic, extrinsic, 3, 2)
    assert rays.shape == (2, 3, 6) and rays.dtype == np.float32
    third, sixth = 1 / 3, 1 / 6
    expected = [[x, y, 1] for y in (-sixth, sixth) for x in (-third, 0, third)]
    np.testing.assert_allclose(rays[..., 3:].reshape(-1, 3), expected, atol=1e-7)
    np.testing.assert_array_equal(rays[..., :3].reshape(-1, 3), [[-1, -2, -3]] * 6)


def test_rays_of_a_pinhole_camera_by_its_field_of_view():
    """The numbers are Open3D 0.20's."""
    rays = RaycastingScene.create_rays_pinhole(
        fov_deg=60, center=[0, 0, 1], eye=[1, 2, 3], up=[0, 1, 0], width_px=3, height_px=2
    )
    np.testing.assert_allclose(rays[0, 0], [1, 2, 3, 0.06830937, -0.8101105, -0.72404414], rtol=1e-6)
    np.testing.assert_allclose(rays[1, 2], [1, 2, 3, -0.7349761, -0.52322286, -0.60928917], rtol=1e-6)
    again = RaycastingScene.create_rays_pinhole(60, [0, 0, 1], [1, 2, 3], [0, 1, 0], 3, 2)
    np.testing.assert_array_equal(rays, again)


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda s: s.cast_rays(RAYS[..., :5]), "rays"),
        (lambda s: s.compute_distance(np.zeros((2, 2))), "query_points"),
        (lambda s: s.compute_occupancy(np.zeros((2, 3)), nsamples=2), "nsamples"),
        (lambda s: s.cast_rays(RAYS, nthreads=-1), "nthreads"),
        (lambda s: s.cast_rays(RAYS, nthreads=10**4), "nthreads"),
        (lambda s: s.test_occlusions(RAYS, tnear=None), "tnear"),
        (lambda s: s.test_occlusions(RAYS, tfar="far"), "tfar"),
        (lambda s: s.add_triangles(SHEETS, [[0, 1, 9]]), "triangle_indices"),
        (lambda s: s.add_triangles(SHEETS, [[0, 1, 2], [0, 1]]), "triangle_indices"),
        (lambda s: s.add_triangles(SHEETS * np.float32(np.nan), [[0, 1, 2]]), "vertex_positions"),
        (lambda s: s.add_triangles("bunny.ply"), "vertex_positions: .*kdray.Scene.of"),
        (lambda s: s.add_triangles(mesh=5), "mesh: int"),
        (lambda s: s.create_rays_pinhole(0, [0, 0, 1], [0, 0, 0], [0, 1, 0], 3, 2), "fov_deg"),
        (lambda s: s.create_rays_pinhole("60", [0, 0, 1], [0, 0, 0], [0, 1, 0], 3, 2), "fov_deg"),
        (lambda s: s.create_rays_pinhole([[1], [2, 3]], np.eye(4), 3, 2), "intrinsic_matrix"),
        (lambda s: s.create_rays_pinhole(60, [0, 1, 0], [0, 0, 0], [0, 1, 0], 3, 2), "up"),
        (lambda s: s.create_rays_pinhole(np.zeros((3, 3)), np.eye(4), 3, 2), "intrinsic_matrix"),
        (lambda s: s.create_rays_pinhole(np.eye(3), np.eye(4), 0, 2), "width_px"),
    ],
)
def test_errors_name_the_argument(sheets, call, name):
    with pytest.raises(kdray.KdrayError, match=f"^{name}"):
        call(sheets)
