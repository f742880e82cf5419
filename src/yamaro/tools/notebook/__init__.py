"""What Jupyter shows of a `Build` or `Robot`: the robot in 3D, in a page of its own."""
