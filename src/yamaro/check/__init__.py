"""The checks of a finished robot."""
