"""Robots as screws and motors: read from URDF files or Denavit-Hartenberg tables into one immutable `RobotModel`."""
