"""The report: its numbers, strict JSON, and what it refuses."""

import json
import re
import stat
from pathlib import Path

import numpy as np
import pytest

from cga_codegen.robots.bundled import bundled_robots
from cga_runtime.errors import CgaError
from cga_runtime.report import nearest, strict_json
from cga_runtime.report.build import SECTIONS, ReportFolderError, build_report
from cga_runtime.report.context import ReportRobotError, Sizes

SMALL = Sizes(samples=60, tries=2, poses=2, grid=9, rounds=1)


def reject(constant: str) -> None:
    raise AssertionError(f"{constant} is not JSON")


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("report") / "new" / "folder"
    steps: list[tuple[int, int]] = []
    data = build_report("nao", folder, lambda done, total: steps.append((done, total)), SMALL)
    return folder, data, steps


def urdf(tmp_path, *changes):
    """The bundled NAO with pieces of its text replaced."""
    text = Path(bundled_robots()["nao"]).read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    (tmp_path / "changed.urdf").write_text(text, encoding="utf-8")
    return str(tmp_path / "changed.urdf")


# ---- numbers


def test_json_is_strict_and_is_what_was_returned(made):
    folder, data, _ = made
    assert json.loads((folder / "report.json").read_text(encoding="utf-8"), parse_constant=reject) == data


def test_the_promised_keys_are_there(made):
    data = made[1]
    promised = {
        "mobility": {"joint_mobility", "object_dof", "motion_generic", "motion_parallel", "limb_ranks", "constraint_rank"},
        "limb": {"q2_star_right", "q2_star_inside_limits", "margin_rad", "factor_identity_error"},
        "constraint": {"object_dof", "joint_mobility", "reachable"},
        "schemes": {"total", "orbits", "admissible", "admissible_orbits", "never", "never_orbits", "singular_on_mirror", "best_median"}
        | {"best_p05", "table"},
        "reaching": {"point", "line", "plane", "sphere", "point_pair", "both_on_line", "rigid_grasp"},
        "cooperative": {"samples", "hands_distance", "hands_meet", "frame", "product_error", "stretched", "point_pair", "line"}
        | {"nullspace", "interpolation", "inverse_kinematics"},
        "nearest": {"limb", "constraint", "actuation"},
        "kernels": {"RHand/motor", "RHand/pose", "RHand+LHand/closure_error"},
    }
    assert data["robot"] == "nao" and data["seconds"] > 0 and {"cga-robotics", "numpy", "casadi", "python"} <= set(data["versions"])
    for section, keys in promised.items():
        assert keys <= set(data[section]), section
    assert list(promised) == [name for name, _, _ in SECTIONS]
    for entry in data["reaching"].values():
        assert {"solved", "tried", "iterations_median", "iterations_max", "seconds_median"} <= set(entry) and entry["tried"] == 2
    for name in ("point_pair", "line"):
        assert data["cooperative"]["inverse_kinematics"][name]["tried"] == 2 and data["cooperative"][name]["full_rank"] == 60
    for entry in data["kernels"].values():
        assert entry["operations"] >= 0 and entry["nanoseconds"]["scalar"] > 0 and entry["nanoseconds"]["batch"] > 0 and entry["compiler"]


def test_mobility_and_motion(made):
    mobility = made[1]["mobility"]
    assert (mobility["joint_mobility"], mobility["object_dof"], mobility["limb_ranks"], mobility["constraint_rank"]) == (4, 4, [5, 5], 2)
    assert (mobility["motion_generic"], mobility["motion_parallel"]) == ("1T3R", "2T2R")
    assert mobility["poses_agreeing"] == mobility["poses_checked"] == 60
    assert mobility["generic"]["inside_limits"] and mobility["parallel"]["inside_limits"]
    assert mobility["generic"]["angle_between_forces"] > 0.5 and mobility["parallel"]["angle_between_forces"] < 1e-12


def test_limb_and_constraint_singularities_are_out_of_reach(made):
    limb, constraint = made[1]["limb"], made[1]["constraint"]
    assert limb["q2_star_right"] == pytest.approx(-np.arctan2(0.105, 0.015), abs=1e-14)
    assert limb["q2_star_left"] == pytest.approx(-limb["q2_star_right"], abs=1e-14)
    assert limb["margin_rad"] == pytest.approx(-1.32645 + np.arctan2(0.105, 0.015), abs=1e-12)
    assert not limb["q2_star_inside_limits"] and not limb["reachable"] and limb["factor_identity_error"] < 1e-12
    assert limb["f_in_limits"] == pytest.approx([0.010847, 0.106066], abs=1e-6)
    assert limb["sin_q4_in_limits"][0] == pytest.approx(np.sin(0.0349066), abs=1e-12)
    assert (constraint["object_dof"], constraint["joint_mobility"], constraint["limb_ranks"], constraint["reachable"]) == (
        3,
        5,
        [4, 4],
        False,
    )
    assert (constraint["force_rank"], constraint["wrench_rank"]) == (1, 3)


def test_atlas(made):
    schemes = made[1]["schemes"]
    counts = [schemes[key] for key in ("total", "orbits", "admissible", "admissible_orbits", "never", "never_orbits", "singular_on_mirror")]
    assert counts == [210, 110, 139, 71, 71, 39, 20]
    assert len(schemes["table"]) == 210 and schemes["samples"] == 60


def test_hands_as_point_pair_and_line(made):
    cooperative = made[1]["cooperative"]
    numbers = {
        name: [cooperative[name][key] for key in ("joints", "task_dimension", "nullspace_dimension")] for name in ("point_pair", "line")
    }
    assert numbers == {"point_pair": [10, 6, 4], "line": [10, 4, 6]} and cooperative["samples"] == 60
    assert cooperative["nullspace"]["q"] == made[1]["mobility"]["generic"]["q"] and len(cooperative["nullspace"]["motions"]) == 6


def test_nearest_finds_none_inside_the_limits_where_none_is(made):
    parts = made[1]["nearest"]
    for kind in ("limb", "constraint"):
        assert parts[kind]["within_limits"]["found"] == 0 and parts[kind]["within_limits"]["median"] is None
        assert parts[kind]["unlimited"]["found"] == 2
    found = parts["actuation"]["unlimited"]
    assert found["minimum"] <= found["median"] <= found["maximum"] and found["distances"] == sorted(found["distances"])


def test_nao_v32_reaches_its_singularities(tmp_path):
    data = build_report("nao_v32", tmp_path, sizes=SMALL)
    assert data["limb"]["q2_star_right"] == pytest.approx(-np.pi / 2, abs=1e-14)
    assert data["limb"]["q2_star_inside_limits"] and data["limb"]["reachable"] and data["constraint"]["reachable"]
    assert (data["schemes"]["admissible"], data["schemes"]["admissible_orbits"]) == (135, 69)
    assert sum(not row["certified"] for row in data["schemes"]["table"]) == 4
    assert "4 schemes called never admissible" in (tmp_path / "index.html").read_text(encoding="utf-8")


def test_a_second_report_replaces_an_older_one_and_differs_in_times_only(made, tmp_path):
    (tmp_path / "report.json").write_text("old")
    (tmp_path / "kept.txt").write_text("not ours")
    again = build_report("nao", str(tmp_path), sizes=SMALL)

    def timeless(value):
        if isinstance(value, dict):
            return {key: timeless(item) for key, item in value.items() if not re.search("seconds$|seconds_", key)}
        return [timeless(item) for item in value] if isinstance(value, list) else value

    assert timeless(again) == timeless(made[1]) and "nanoseconds" not in json.dumps(timeless(again))
    assert sorted(file.name for file in tmp_path.iterdir()) == ["index.html", "kept.txt", "report.json"]
    assert all(stat.S_IMODE((tmp_path / name).stat().st_mode) == 0o644 for name in ("index.html", "report.json"))
    assert json.loads((tmp_path / "report.json").read_text(encoding="utf-8")) == again


def test_progress_ends_at_its_total(made):
    steps = made[2]
    done = [step for step, _ in steps]
    assert done == sorted(done) and len({total for _, total in steps}) == 1 and steps[-1][0] == steps[-1][1]
    assert len(steps) == len(SECTIONS) + 1


# ---- JSON


def test_plain_refuses_what_json_cannot_say():
    for value in (float("nan"), np.inf, [np.float64("nan")], {"a": -np.inf}):
        with pytest.raises(ValueError, match="cannot be written as JSON"):
            strict_json.plain(value)
    with pytest.raises(TypeError, match="set cannot be written"):
        strict_json.plain({1, 2})
    assert strict_json.plain({"a": np.float64(1.5), 2: (np.int64(3), np.bool_(True), None)}) == {"a": 1.5, "2": [3, True, None]}
    assert strict_json.plain(np.pi, 3) == 3.14


def test_json_in_a_script_cannot_end_it():
    text = strict_json.for_script({"a": "</script><!--&", "b": [1.23456789]}, 3)
    assert not set("<>&") & set(text) and json.loads(text) == {"a": "</script><!--&", "b": [1.23]}


# ---- refusals


def test_out_that_is_a_file_is_refused_before_work(tmp_path):
    (tmp_path / "file").write_text("")
    for out in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(ReportFolderError, match="--out") as caught:
            build_report("nao", out, sizes=SMALL)
        assert isinstance(caught.value, CgaError) and str(tmp_path / "file") in str(caught.value)


def test_out_that_cannot_be_written_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("os.access", lambda path, mode: False)
    with pytest.raises(ReportFolderError, match="cannot be written"):
        build_report("nao", tmp_path, sizes=SMALL)


def test_robots_of_another_kind_are_refused_with_what_is_needed(tmp_path):
    with pytest.raises(ReportRobotError, match="no frame RHand: the report needs two arms.*cga report nao"):
        build_report(urdf(tmp_path, ('"RHand"', '"RTool"')), tmp_path / "out", sizes=SMALL)
    text = Path(bundled_robots()["nao"]).read_text(encoding="utf-8")
    joint = re.search(r'<joint name="RWristYaw".*?</joint>', text, re.S).group(0)
    moved = re.sub(r'xyz="(\S+) (\S+) (\S+)"', r'xyz="\1 0.01 \3"', joint, count=1)
    assert moved != joint  # the last axis no longer meets the two before it
    with pytest.raises(ReportRobotError, match="no wrist centre"):
        build_report(urdf(tmp_path, (joint, moved)), tmp_path / "out", sizes=SMALL)
    assert list((tmp_path / "out").iterdir()) == []


def test_a_section_that_fails_fails_the_report(tmp_path, monkeypatch):
    def broken(context):
        raise RuntimeError("broken on purpose")

    monkeypatch.setattr(nearest, "section", broken)
    with pytest.raises(RuntimeError, match="broken on purpose"):
        build_report("nao", tmp_path, sizes=SMALL)
    assert list(tmp_path.iterdir()) == []
