"""Pictures and films of a robot: `yamaro picture`."""
