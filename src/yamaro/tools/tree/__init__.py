"""The kinematic tree of a robot, as text: `yamaro tree`."""
