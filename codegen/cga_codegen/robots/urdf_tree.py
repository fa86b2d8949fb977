"""How the links and joints of a URDF hang together: one tree, perhaps on a floating base, and who mimics whom."""

from __future__ import annotations

from dataclasses import dataclass

from cga_codegen.robots.errors import BadNumberError, DuplicateNameError, TreeError, UnsupportedJointError

LARGEST = 1e50
"""Lengths, masses, inertias and ratios stay below it, so that no product of a few of them overflows."""


@dataclass(frozen=True)
class Follow:
    """What a mimicking joint does: q = ratio q_joint + shift, `joint` one that follows no other."""

    joint: str
    ratio: float
    shift: float


def check_tree(where: str, links: set[str], ends: dict[str, tuple[str, str]]) -> None:
    """Raises TreeError unless the joints (name -> parent and child link) hang all links on one root."""
    above: dict[str, str] = {}
    for name, (_, child) in ends.items():
        if child in above:
            raise TreeError(f"{where}: link {child!r} is the child of joints {above[child]!r} and {name!r}; a tree has no loops")
        above[child] = name
    roots = sorted(links - above.keys())
    if len(roots) > 1:
        shown = ", ".join(map(repr, roots[:4])) + (", ..." if len(roots) > 4 else "")
        raise TreeError(f"{where}: {len(roots)} links have no parent joint ({shown}); exactly one root is needed")
    below: dict[str, list[str]] = {}
    for parent, child in ends.values():
        below.setdefault(parent, []).append(child)
    reached, front = set(roots), list(roots)
    while front:
        front = [child for link in front for child in below.get(link, [])]
        reached.update(front)
    if lost := sorted(links - reached):
        raise TreeError(f"{where}: link {lost[0]!r} hangs in a loop of joints; every link must be reached from one root")
    if "universe" in links and roots != ["universe"]:
        raise DuplicateNameError(f"{where}: link 'universe' is not the root, but the fixed world is so called; rename it")


def check_base(where: str, floating: list[str], ends: dict[str, tuple[str, str]]) -> None:
    """A floating joint is the base of the robot: it carries everything."""
    roots = {parent for parent, _ in ends.values()} - {child for _, child in ends.values()}
    for name in floating:
        if ends[name][0] not in roots or sum(parent in roots for parent, _ in ends.values()) > 1:
            raise UnsupportedJointError(
                f"{where}: joint {name!r} floats, but does not carry the whole robot; only a floating base can be represented"
            )


def leaders(where: str, follows: dict[str, Follow], kinds: dict[str, str]) -> dict[str, Follow]:
    """Joints that mimic mimicking joints follow their leader's leader: q = m1 (m2 q + o2) + o1."""
    found = {}
    for name, follow in follows.items():
        label, seen = f"{where}: joint {name!r}", {name}
        while True:
            if follow.joint not in kinds:
                raise UnsupportedJointError(
                    f"{label} mimics {follow.joint[:80]!r}, which is no moving joint; name one that moves, or ask for mimic='independent'"
                )
            if follow.joint in seen:
                raise UnsupportedJointError(f"{label} mimics itself in the end; one joint must move by itself")
            if follow.joint not in follows:
                break
            seen.add(follow.joint)
            above = follows[follow.joint]
            follow = Follow(above.joint, follow.ratio * above.ratio, follow.ratio * above.shift + follow.shift)
        if max(abs(follow.ratio), abs(follow.shift)) >= LARGEST:
            total = f"multiplier {follow.ratio:g} and offset {follow.shift:g}"
            raise BadNumberError(f"{label} mimics {follow.joint!r} by way of others with {total}; less than {LARGEST:g} is needed")
        found[name] = follow
    return found
