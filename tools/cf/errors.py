"""errors.py - how a command ends when it does not end well."""


class Refused(Exception):
    """Bad input. One line: what, and what is allowed. Exit 2."""


class Failed(Exception):
    """Anything else. Exit 1."""


class Stopped(Failed):
    """The motors were cut by hand. Exit 1."""


class LinkLost(Failed):
    """The Crazyflie no longer answers. Exit 1."""
