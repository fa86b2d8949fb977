"""The commands of `cga`, one file for each subject; cli.py registers them."""
