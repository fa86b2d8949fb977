"""Robot kernels from the rules of geometric algebra: kinematics, closed chains, reaching, and their analyses.

    import cga_runtime as cga
    arm = cga.load_robot("nao").chain("RHand")
    arm.pose(q); arm.jacobian(q); arm.casadi("motor")
"""

from cga_runtime.analysis.closed_chain import ClosedChain as ClosedChain
from cga_runtime.configurations import from_mujoco as from_mujoco
from cga_runtime.configurations import from_pinocchio as from_pinocchio
from cga_runtime.configurations import to_mujoco as to_mujoco
from cga_runtime.configurations import to_pinocchio as to_pinocchio
from cga_runtime.conventions import adjoint as adjoint
from cga_runtime.conventions import coadjoint as coadjoint
from cga_runtime.conventions import convert_twist as convert_twist
from cga_runtime.conventions import convert_wrench as convert_wrench
from cga_runtime.conventions import jacobian_in_frame as jacobian_in_frame
from cga_runtime.conventions import twist_in_frame as twist_in_frame
from cga_runtime.conventions import wrench_in_frame as wrench_in_frame
from cga_runtime.elements import Circle as Circle
from cga_runtime.elements import Line as Line
from cga_runtime.elements import Plane as Plane
from cga_runtime.elements import Point as Point
from cga_runtime.elements import PointPair as PointPair
from cga_runtime.elements import Sphere as Sphere
from cga_runtime.elements.charts import chart_of as chart_of
from cga_runtime.elements.distances import contains as contains
from cga_runtime.elements.distances import distance as distance
from cga_runtime.elements.distances import incidence as incidence
from cga_runtime.elements.distances import project as project
from cga_runtime.elements.joins import handedness as handedness
from cga_runtime.elements.joins import join as join
from cga_runtime.elements.joins import weight as weight
from cga_runtime.elements.meets import intersection as intersection
from cga_runtime.elements.meets import meet as meet
from cga_runtime.elements.reading import element_of as element_of
from cga_runtime.elements.similarities import interpolate as interpolate
from cga_runtime.elements.similarities import similarity_between as similarity_between
from cga_runtime.elements.similarities import similarity_of as similarity_of
from cga_runtime.elements.similarities import unit_primitive as unit_primitive
from cga_runtime.elements.through_points import degenerate as degenerate
from cga_runtime.errors import CacheError as CacheError
from cga_runtime.errors import CgaError as CgaError
from cga_runtime.errors import ChainError as ChainError
from cga_runtime.errors import CompilerError as CompilerError
from cga_runtime.errors import DegenerateError as DegenerateError
from cga_runtime.errors import FolderError as FolderError
from cga_runtime.errors import GraspError as GraspError
from cga_runtime.errors import KernelWarning as KernelWarning
from cga_runtime.errors import MissingExtraError as MissingExtraError
from cga_runtime.errors import NotFiniteError as NotFiniteError
from cga_runtime.errors import RobotFileError as RobotFileError
from cga_runtime.errors import SchemeError as SchemeError
from cga_runtime.errors import StaleKernelError as StaleKernelError
from cga_runtime.errors import UnknownNameError as UnknownNameError
from cga_runtime.errors import WrongSizeError as WrongSizeError
from cga_runtime.loading import bundled_robots as bundled_robots
from cga_runtime.loading import load_robot as load_robot
from cga_runtime.motors import Motor as Motor
from cga_runtime.multivectors import Multivector as Multivector
from cga_runtime.quaternions import convert_quaternion as convert_quaternion
from cga_runtime.quaternions import dual_quaternion_from_motor as dual_quaternion_from_motor
from cga_runtime.quaternions import matrix_from_quaternion as matrix_from_quaternion
from cga_runtime.quaternions import motor_from_dual_quaternion as motor_from_dual_quaternion
from cga_runtime.quaternions import motor_from_position_quaternion as motor_from_position_quaternion
from cga_runtime.quaternions import position_quaternion_from_motor as position_quaternion_from_motor
from cga_runtime.quaternions import quaternion_from_matrix as quaternion_from_matrix
from cga_runtime.robot import Chain as Chain
from cga_runtime.robot import Robot as Robot
from cga_runtime.solve.inverse_kinematics import Solutions as Solutions
from cga_runtime.solve.inverse_kinematics import inverse_kinematics as inverse_kinematics
from cga_runtime.solve.reaching import Solution as Solution
from cga_runtime.solve.reaching import reach as reach
from cga_runtime.solve.resolved_rates import resolved_rates as resolved_rates
from cga_runtime.solve.resolved_rates import twist_towards as twist_towards
from cga_runtime.spaces.cooperative import Cooperative as Cooperative
from cga_runtime.spaces.dual_task import DualTaskSpace as DualTaskSpace
from cga_runtime.spaces.hypersphere import Hypersphere as Hypersphere
from cga_runtime.spaces.hypersphere import HypersphereSpace as HypersphereSpace
from cga_runtime.versors import Dilator as Dilator
from cga_runtime.versors import Rotor as Rotor
from cga_runtime.versors import Similarity as Similarity
from cga_runtime.versors import Translator as Translator

__version__ = "0.1.0"
