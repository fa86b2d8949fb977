"""The exported C library: clean under all warnings, without state, the same to the byte, installable, whatever its robot is called."""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import casadi
import numpy as np
import pytest

import cga_runtime as cga
from cga_codegen.emit.manifest import GeneratedFolderError, digest
from cga_codegen.export import export_robot, word
from cga_codegen.robots.from_urdf import load_urdf
from cga_codegen.robots.model import ModelError, RobotModel
from cga_runtime.compile import find_compiler

STRICT = ("-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-fPIC")
CHAIN = ("motor", "pose", "jacobian_local", "jacobian_derivative_local", "hessian_local")
TREE = ("frames", "center_of_mass", "inverse_dynamics", "gravity", "forward_dynamics")
SMALL = Path(__file__).parents[1] / "data" / "four_links.urdf"
"""A turning and a sliding joint, and one that mimics: every form that (c, s) take."""


def silent(line: str) -> None:
    """Progress that nobody reads."""


def files(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def run(*command: object, cwd: Path | None = None) -> str:
    done = subprocess.run([str(part) for part in command], cwd=cwd, capture_output=True, text=True)
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def compiler() -> tuple[str, ...]:
    found = find_compiler(None)
    assert found is not None
    return found.command


def cmake() -> str:
    """The program, installed or from pip (`cmake` among the extras for development)."""
    found = shutil.which("cmake", path=os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")]))
    if found is None:
        pytest.fail("this test needs CMake 3.15 or later: pip install cmake")
    return found


@pytest.fixture(scope="module")
def small() -> RobotModel:
    return load_urdf(SMALL)


@pytest.fixture(scope="module")
def folder(small: RobotModel, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One of each sort: of all orders of derivatives, of one input and several, vectors, matrices and what has three indices."""
    out = tmp_path_factory.mktemp("export") / "small"
    export_robot(small, out, ["d"], TREE, silent, 2, CHAIN)
    return out


def test_what_the_folder_holds(folder: Path) -> None:
    manifest = json.loads((folder / "manifest.json").read_text())
    found = files(folder)
    others = [
        "CMakeLists.txt",
        "README.md",
        "example/CMakeLists.txt",
        "example/main.c",
        "include/cga_small.h",
        "src/external.h",
        "src/kernel.h",
    ]
    assert sorted(found) == sorted([*others, "manifest.json", *(f"src/{name}.c" for name in CHAIN + TREE)])
    assert {path: digest(text.decode()) for path, text in found.items() if path != "manifest.json"} == manifest["files"]
    assert sorted(manifest["functions"]) == sorted(f"small_{name}" for name in CHAIN + TREE)
    header, readme = found["include/cga_small.h"].decode(), found["README.md"].decode()
    for name, function in manifest["functions"].items():
        source = found[f"src/{name.removeprefix('small_')}.c"].decode()
        counts = {"jac_" * order + name: count for order, count in enumerate(function["operations"])}
        assert f"{'; '.join(f'{key}: {count} operations' for key, count in counts.items())}." in source.split("*/")[0]
        assert sum(map(int, re.findall(r"(\d+) (?:mul|add|div|sqrt)", source))) == sum(counts.values())
        assert f"int cga_{name}(" in header and f"int cga_{name}_batch(int64_t n, " in header and f"`cga_{name}(" in readme


def test_sources_keep_no_state_and_bodies_call_nothing(folder: Path) -> None:
    texts = {path: text.decode() for path, text in files(folder).items() if path.endswith((".c", ".h"))}
    library = {path: text for path, text in texts.items() if not path.startswith("example")}
    for path, text in library.items():
        code = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
        assert not re.search(r"\b(malloc|calloc|realloc|free|goto)\b", code), path
        for line in code.splitlines():  # a variable at file scope is a constant
            assert not re.match(r"(static )?(?!const|inline|CGA_NOINLINE)\w+ \**\w+(\[\w*\])?( =|;)", line), f"{path}: {line}"
        bodies = re.findall(r"^static \w+ void \w+_(?:body|part\d+)\(.*?^}", code, flags=re.MULTILINE | re.DOTALL)
        assert len(bodies) > 0 or path.endswith(".h")
        assert not any(re.search(r"\b(sin|cos|if|for)\b", body) for body in bodies), path


@pytest.mark.compiler
def test_c_is_clean_under_all_warnings(folder: Path, tmp_path: Path) -> None:
    for source in sorted((folder / "src").glob("*.c")):
        run(*compiler(), *STRICT, "-c", source, "-o", tmp_path / "one.o")
    run(*compiler(), *STRICT, f"-I{folder / 'include'}", "-c", folder / "example" / "main.c", "-o", tmp_path / "one.o")


def test_the_header_is_guarded_for_cpp(folder: Path) -> None:
    header = re.sub(r"/\*.*?\*/", "", (folder / "include" / "cga_small.h").read_text(), flags=re.DOTALL)
    before, _, after = header.partition('#ifdef __cplusplus\nextern "C" {\n#endif\n')
    declared, _, end = after.partition("#ifdef __cplusplus\n}\n#endif\n")
    assert before.split() and "CGA_EXPORT int" not in before + end and declared.count("CGA_EXPORT int") == 2 * len(CHAIN + TREE)
    assert "restrict" not in header  # no word of C++


def test_two_exports_are_the_same_to_the_byte(small: RobotModel, tmp_path: Path) -> None:
    """In two processes, whose sets and dictionaries are ordered differently."""
    script = """\
import sys
from pathlib import Path
from cga_codegen.export import export_robot
from cga_codegen.robots.from_urdf import load_urdf
model = load_urdf(Path(sys.argv[1]))
export_robot(model, Path(sys.argv[2]), ["d", "c"], ["gravity", "frames"], len, 2, ["pose", "jacobian_derivative_local"])
"""
    for seed in ("1", "2"):
        command = [sys.executable, "-c", script, str(SMALL), seed]
        subprocess.run(command, cwd=tmp_path, check=True, env={**os.environ, "PYTHONHASHSEED": seed})
    first, second = files(tmp_path / "1"), files(tmp_path / "2")
    assert first == second and {"src/d_pose.c", "src/c_pose.c", "src/gravity.c"} < set(first)


@pytest.mark.compiler
def test_cmake_installs_it_and_the_example_finds_it(small: RobotModel, tmp_path: Path) -> None:
    """Configured, built and installed; then the example, copied elsewhere, finds the package and prints what the runtime computes."""
    chosen = ["pose", "jacobian_local_world_aligned"]
    export_robot(small, tmp_path / "small", ["d"], ["inverse_dynamics"], silent, 0, chosen)
    shutil.copytree(tmp_path / "small" / "example", tmp_path / "elsewhere")
    shutil.copytree(tmp_path / "small" / "example", tmp_path / "inside")
    environment = [f"-DCMAKE_C_COMPILER={compiler()[0]}", "-DCMAKE_C_FLAGS=-pedantic -Wall -Wextra -Werror"]
    tool, built, installed = cmake(), tmp_path / "build", tmp_path / "installed"
    run(tool, "-S", tmp_path / "small", "-B", built, "-DCGA_EXAMPLE=ON", *environment)
    run(tool, "--build", built)
    run(tool, "--install", built, "--prefix", installed)
    (tmp_path / "small").rename(tmp_path / "gone")
    run(tool, "-S", tmp_path / "elsewhere", "-B", tmp_path / "other", f"-DCMAKE_PREFIX_PATH={installed}", *environment)
    run(tool, "--build", tmp_path / "other")
    printed = run(tmp_path / "other" / "cga_small_example")
    assert printed == run(built / "example" / "cga_small_example")
    blocks = re.split(r"^small_(\w+)\n", printed, flags=re.MULTILINE)[1:]
    values = {
        name: np.array([line.split() for line in text.splitlines()], dtype=float)
        for name, text in zip(blocks[::2], blocks[1::2], strict=True)
    }
    robot = cga.load_robot(SMALL)
    arm, q, v = robot.chain("d"), np.array([0.1, 0.2, 0.3]), np.array([0.01, 0.02, 0.03])
    expected = {"pose": arm.pose(q), chosen[1]: arm.jacobian(q), "inverse_dynamics": robot.inverse_dynamics(q, v, v)[None]}
    assert list(values) == list(expected)
    for name, value in values.items():
        assert np.abs(value - expected[name]).max() <= 2e-15 * np.abs(expected[name]).max(), name


HOSTILE = ['quo"te', "../../it's/passwd", "int", "Ærøbot 机器人", "9 lives*/", "a\\nb??/\n", "${HOME} @{robot} $<0:x>", "_", ""]


@pytest.mark.compiler
@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_names(small: RobotModel, tmp_path: Path, name: str) -> None:
    """Names of robots, frames and joints come from files: they go into C, CMake, paths and CasADi only as plain words."""
    frames = tuple(replace(frame, name=f"{name}{frame.name}") for frame in small.frames)
    joints = tuple(replace(joint, name=f"{name}{joint.name}", follows=joint.follows and f"{name}{joint.follows}") for joint in small.joints)
    out = tmp_path / "box" / "out"
    manifest = export_robot(
        replace(small, name=name, frames=frames, joints=joints), out, [f"{name}a", f"{name}c"], ["frames"], silent, 1, ["point"]
    )
    assert [path.name for path in tmp_path.iterdir()] == ["box"] and [path.name for path in (tmp_path / "box").iterdir()] == ["out"]
    assert set(files(out)) == {*manifest["files"], "manifest.json"} and all(re.fullmatch(r"[\w./]+", path, re.ASCII) for path in files(out))
    assert all(casadi.Function.check_name(key) for key in manifest["functions"])
    run(*compiler(), *STRICT, "-fsyntax-only", *sorted(out.glob("src/*.c")), out / "example" / "main.c", f"-I{out / 'include'}")
    assert all(text.isascii() for text in files(out).values())
    if name in ("int", "${HOME} @{robot} $<0:x>"):  # CMake reads the name too
        with tempfile.TemporaryDirectory(dir=tmp_path) as build:
            run(cmake(), "-S", out, "-B", build, f"-DCMAKE_C_COMPILER={compiler()[0]}")


def test_words() -> None:
    assert [word(name) for name in ("panda", "RHand", "a b", "9", "_", "", "a__b_")] == [
        "panda",
        "RHand",
        "a_x20_b",
        "x39",
        "robot",
        "x0",
        "a_b",
    ]


def test_names_that_would_become_the_same(small: RobotModel, tmp_path: Path) -> None:
    for first, second in (("a_b", "a__b"), ("Hand", "hand")):  # the second pair: on file systems that take them for one
        frames = (*small.frames, replace(small.frame("c"), name=first), replace(small.frame("d"), name=second))
        with pytest.raises(ModelError, match=f"small: two functions would be called .*{first.lower()}_point; export their frames into"):
            export_robot(replace(small, frames=frames), tmp_path / "out", [first, second], [], silent, 2, ["point"])
    assert not (tmp_path / "out").exists()


REFUSED = [
    (["base"], [], (), "no joint lies between the base and 'base'"),
    (["nowhere"], [], ("point",), "small has no frame 'nowhere'; frames: "),
    (["a"], ["kinetic"], ("point",), "no kernel of a tree is called 'kinetic'; kernels: frames, "),
    (["a"], [], ("frames",), "no kernel of a chain is called 'frames'; kernels: motor, "),
    ([], [], ("point",), "small: nothing to export; name a frame that moves"),
]


@pytest.mark.parametrize(("frames", "tree", "kernels", "sentence"), REFUSED)
def test_what_cannot_be_exported(small: RobotModel, tmp_path: Path, frames, tree, kernels, sentence) -> None:
    with pytest.raises(ModelError, match=re.escape(sentence)):
        export_robot(small, tmp_path / "out", frames, tree, silent, 2, kernels)
    assert not (tmp_path / "out").exists()


def test_kernels_that_do_not_exist_are_left_out_and_said(tmp_path: Path) -> None:
    said: list[str] = []
    model = load_urdf(Path(__file__).parents[1] / "data" / "skew.urdf")  # nothing of it has mass
    manifest = export_robot(model, tmp_path / "out", [], ["gravity", "forward_dynamics", "center_of_mass"], said.append, 1)
    assert list(manifest["functions"]) == ["skew_gravity"] and sorted(manifest["left_out"]) == ["center_of_mass", "forward_dynamics"]
    assert sum(line.startswith("left out: ") for line in said) == 2
    assert (tmp_path / "out" / "README.md").read_text().count("Not exported: ") == 2


def test_folders_of_others_and_folders_that_cannot_be_written(small: RobotModel, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def export(name: str, kernel: str = "point") -> None:
        export_robot(small, tmp_path / name, ["a"], [], silent, 0, [kernel])

    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.tex").write_text("precious")
    with pytest.raises(GeneratedFolderError, match="mine is not empty and holds no manifest.json"):
        export("mine")
    assert files(tmp_path / "mine") == {"thesis.tex": b"precious"}
    with pytest.raises(GeneratedFolderError, match=r"^cannot write .*/thesis.tex: File exists$"):
        export("mine/thesis.tex")
    export("out")
    (tmp_path / "out" / "notes.txt").write_text("kept")
    export("out", "pose")  # over an earlier export: its files go, others stay
    assert {"src/pose.c", "notes.txt"} < set(files(tmp_path / "out")) and "src/point.c" not in files(tmp_path / "out")
    before = files(tmp_path / "out")

    def read_only(dir: Path, **_: object) -> None:  # root may write everywhere, so the system's answer is played
        raise PermissionError(13, "Permission denied", str(dir))

    monkeypatch.setattr(tempfile, "mkstemp", read_only)
    with pytest.raises(GeneratedFolderError, match=r"^cannot write .*/out.*: Permission denied$"):
        export("out")
    assert files(tmp_path / "out") == before
