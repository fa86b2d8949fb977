"""What ClosedChain refuses, and in which words: arms that make no loop, wrong configurations, schemes that are none."""

import numpy as np
import pytest

from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.errors import DegenerateError, GraspError, NotFiniteError, SchemeError, UnknownNameError, WrongSizeError
from cga_runtime.loading import load_robot
from cga_runtime.spaces.loop_walk import close_loop

ROBOT = load_robot("nao")
LOOP = ClosedChain(ROBOT.chain("RHand"), ROBOT.chain("LHand"))


def test_arms_that_cannot_form_a_loop():
    hand = ROBOT.chain("RHand")
    with pytest.raises(GraspError, match=r"share joints \(RElbowRoll, RElbowYaw, RShoulderPitch, .*separate arms"):
        ClosedChain(hand, ROBOT.chain("RForeArm"))
    with pytest.raises(GraspError, match=r"^2 \+ 4 joints hold an object rigidly: a closed chain needs more than six$"):
        ClosedChain(ROBOT.chain("RBicep"), ROBOT.chain("LForeArm"))
    with pytest.raises(GraspError, match="share joints"):
        ClosedChain(hand, load_robot("nao").chain("RHand"))  # loaded twice, it is still one robot
    aside = np.eye(4)
    aside[1, 3] = 0.5
    assert ClosedChain(hand, ROBOT.chain("RHand", placement=aside)).n == 10  # another robot of the kind, standing elsewhere
    with pytest.raises(GraspError, match="^the two chains begin in different frames \\('RShoulder' and 'the base'\\): a closed chain"):
        ClosedChain(ROBOT.chain("RHand", root="RShoulder"), ROBOT.chain("LHand"))
    with pytest.raises(GraspError, match="^a closed chain needs two Chains, str given$"):
        ClosedChain(hand, "LHand")


def test_a_robot_loaded_twice_has_the_checked_in_loop():
    loop = ClosedChain(ROBOT.chain("RHand"), load_robot("nao").chain("LHand"))
    assert loop == ClosedChain(ROBOT.chain("RHand"), ROBOT.chain("LHand"))


@pytest.mark.parametrize("grasp", [np.zeros(8), 1e-12 * np.eye(8)[0], 2.0 * np.eye(8)[0]])
def test_a_grasp_that_is_no_motor_holds_nothing(grasp):
    q = LOOP.random(np.random.default_rng(0))
    for call in (LOOP.closure_error, LOOP.require_closed, lambda q, grasp: close_loop(LOOP, q, grasp)):
        with pytest.raises(DegenerateError, match="M ~M must be 1"):
            call(q, grasp)


@pytest.mark.parametrize("options", [{"samples": 0}, {"samples": -1}, {"samples": 2.5}, {"seed": -1}, {"seed": "a"}])
def test_counts_of_samples_are_checked(options):
    with pytest.raises(WrongSizeError, match=next(iter(options))):
        LOOP.schemes(**options)
    with pytest.raises(WrongSizeError, match=next(iter(options))):
        LOOP.singularity_free_box(np.full(10, 0.1), (1, 3, 7, 8), **options)


def test_starts_of_a_search_are_checked():
    for starts in (0, -1, 1.5):
        with pytest.raises(WrongSizeError, match="starts"):
            LOOP.nearest_singularity(np.full(10, 0.1), starts=starts)


def test_sizes_may_be_numpy_integers():
    rng = np.random.default_rng(0)
    assert LOOP.random(rng, np.int64(3)).shape == (3, 10) and ROBOT.random(rng, np.int64(2)).shape == (2, 10)
    with pytest.raises(WrongSizeError, match="size"):
        ROBOT.random(rng, -1)


def test_bad_configurations():
    for wrong in (np.zeros(9), np.zeros((10, 2)), 0.0):
        with pytest.raises(WrongSizeError, match=r"\(\.\.\., 10\) needed: RShoulderPitch, .*, LWristYaw"):
            LOOP.check(wrong)
    with pytest.raises(WrongSizeError, match="not an array of numbers"):
        LOOP.check(["a"] * 10)
    for value in (np.nan, np.inf):
        q = np.zeros(10)
        q[3] = value
        for function in (LOOP.check, LOOP.twists, LOOP.grasp, lambda x: LOOP.determinant(x, (1, 2, 3, 4))):
            with pytest.raises(NotFiniteError, match="NaN or infinity"):
                function(q)
    with pytest.raises(WrongSizeError, match=r"grasp .*shape \(7,\) given, \(\.\.\., 8\) needed"):
        LOOP.closure_error(np.zeros(10), np.zeros(7))
    with pytest.raises(UnknownNameError, match="unknown kernel 'hand'; known: .*closure_error"):
        LOOP.kernel("hand")


WRONG = [(1, 2, 3), (1, 2, 3, 4, 5), (1, 2, 3, 3), (0, 1, 2, 3), (2, 3, 4, 11), (-1, 2, 3, 4), ()]
NOT_NUMBERS = [(1, 2, 3, 4.5), (1.0, 2.0, 3.0, 7.0), "1237", ("1", "2", "3", "7"), 1237, None, (1, 2, 3, None)]


@pytest.mark.parametrize("actuated", WRONG, ids=str)
def test_schemes_that_are_none(actuated):
    with pytest.raises(SchemeError) as caught:
        LOOP.scheme(actuated)
    assert str(caught.value) == f"scheme {actuated}: 4 distinct joint numbers from 1 to 10 are needed"
    for function in (LOOP.determinant, LOOP.determinant_gradient, LOOP.conditioning, LOOP.symbolic_determinant):
        with pytest.raises(SchemeError):
            function(np.zeros(10), actuated)


@pytest.mark.parametrize("actuated", NOT_NUMBERS, ids=repr)
def test_schemes_that_are_no_integers(actuated):
    """Rounding 4.5 or reading text would silently answer another question."""
    with pytest.raises(SchemeError) as caught:
        LOOP.scheme(actuated)
    assert str(caught.value) == f"scheme {actuated!r}: 4 joint numbers are needed"


def test_schemes_in_any_order():
    assert LOOP.scheme(np.array([8, 1, 7, 3])) == ((0, 2, 6, 7), (1, 3, 4, 5, 8, 9))
    assert LOOP.scheme({3, 7, 8, 1}) == LOOP.scheme([1, 3, 7, 8])
    q = LOOP.random(np.random.default_rng(9))
    assert LOOP.determinant(q, (8, 7, 3, 1)) == LOOP.determinant(q, (1, 3, 7, 8))
