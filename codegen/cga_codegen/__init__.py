"""From the rules of geometric algebra and a robot's description to kernels: exact tables, typed functions, C and Python text."""

__version__ = "0.1.0"
