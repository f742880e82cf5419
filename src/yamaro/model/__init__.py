"""What a robot is: shapes, poses, inertia."""
