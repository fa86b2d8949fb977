"""Names in robot files reach generated text, symbols and paths only in a form that can do no harm and that keeps them apart."""

import numpy as np
import pytest

import cga_runtime as cga
from cga_codegen.generate import Selection, generate, generate_robot
from cga_codegen.robots.from_urdf import load_urdf
from cga_codegen.robots.model import ModelError
from cga_codegen.units import identifier


def silent(_: str) -> None:
    pass


def robot(*names: str, title: str = "small"):
    """A robot with one joint (about z) to each named link, all characters written as numbers."""

    def xml(text: str) -> str:
        return "".join(f"&#{ord(c)};" for c in text)

    joint = '<link name="{0}"/><joint name="to {0}" type="continuous"><parent link="base"/><child link="{0}"/><axis xyz="0 0 1"/></joint>'
    return load_urdf(f'<robot name="{xml(title)}"><link name="base"/>{"".join(joint.format(xml(name)) for name in names)}</robot>')


HOSTILE = [
    'x"""\nraise SystemExit("code from a robot file was run")\n"""',
    "x*/\n#error code from a robot file was compiled\n/*",
    "x\\", "x\\N{x}", "x*??/\n/", "../../escape", "ünïcödé 日本", "a b;c", "9lives", "x\ny",
]  # fmt: skip


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_names_of_links_and_robots(tmp_path, name):
    model = robot(name, title=name)
    assert model.name == name
    generate([(model, Selection([name], (), ()))], tmp_path / "out", silent)
    assert all(str(path.relative_to(tmp_path)).isascii() for path in (tmp_path / "out").rglob("*"))
    chain = cga.load_robot(name, folder=tmp_path / "out").chain(name)
    quarter = [[0.0, -1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
    assert np.abs(chain.pose([np.pi / 2]) - quarter).max() < 1e-15
    assert np.abs(np.array(chain.casadi("pose")(np.pi / 2)) - quarter).max() < 1e-15


def test_names_that_differ_stay_different():
    names = ["a/b", "a_x2f_b", "a_b", "a-b", "a_x2d_b", "_x2f/", "/x2f_", "9a", "_9a", "_x39_a", "", "_", "x", "_x", "__x", "A", "a"]
    assert len({identifier(name) for name in names}) == len(names)
    assert all(identifier(name).isidentifier() and identifier(name).isascii() for name in names)
    assert identifier("RHand_with_LHand") == "RHand_with_LHand"


def test_two_subjects_of_one_name_are_refused():
    model = robot("left", "right", "left_with_right")
    generate_robot(model, Selection(["left", "right"], [("left", "right")], ()), silent)
    with pytest.raises(ModelError, match="^small: two chains or loops would be called robots/small/left_with_right.c; generate"):
        generate_robot(model, Selection(["left_with_right"], [("left", "right")], ()), silent)


def test_a_frame_that_does_not_move_is_refused(tmp_path):
    with pytest.raises(ModelError, match="^small: no joint lies between the root and 'base'; name a frame that moves$"):
        generate([(robot("a"), Selection(["base"], (), ()))], tmp_path, silent)


def test_a_loop_of_arms_that_share_joints_is_refused():
    links = "".join(f'<link name="{name}"/>' for name in ("base", "trunk", "left", "right"))
    joint = '<joint name="to {1}" type="continuous"><parent link="{0}"/><child link="{1}"/></joint>'
    joints = "".join(joint.format(*ends) for ends in (("base", "trunk"), ("trunk", "left"), ("trunk", "right")))
    model = load_urdf(f'<robot name="small">{links}{joints}</robot>')
    with pytest.raises(ModelError, match=r"^small: the chains to left and right share joints \(to trunk\); a loop needs separate arms$"):
        generate_robot(model, Selection(["left"], [("left", "right")], ()), silent)
