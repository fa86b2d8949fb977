"""Robot kernels from the rules of geometric algebra: kinematics, closed chains, reaching, and their analyses.

    import cga_runtime as cga
    arm = cga.load_robot("nao").chain("RHand")
    arm.pose(q); arm.jacobian(q); arm.casadi("motor")
"""

from cga_runtime.errors import CacheError as CacheError
from cga_runtime.errors import CgaError as CgaError
from cga_runtime.errors import CompilerError as CompilerError
from cga_runtime.errors import DegenerateError as DegenerateError
from cga_runtime.errors import GraspError as GraspError
from cga_runtime.errors import KernelWarning as KernelWarning
from cga_runtime.errors import MissingExtraError as MissingExtraError
from cga_runtime.errors import NotFiniteError as NotFiniteError
from cga_runtime.errors import RobotFileError as RobotFileError
from cga_runtime.errors import SchemeError as SchemeError
from cga_runtime.errors import StaleKernelError as StaleKernelError
from cga_runtime.errors import UnknownNameError as UnknownNameError
from cga_runtime.errors import WrongSizeError as WrongSizeError
from cga_runtime.robot import Chain as Chain
from cga_runtime.robot import Robot as Robot
from cga_runtime.robot import bundled_robots as bundled_robots
from cga_runtime.robot import load_robot as load_robot
from cga_runtime.spaces.closed_chain import ClosedChain as ClosedChain

__version__ = "0.1.0"
