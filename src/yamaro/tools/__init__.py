"""What stands on top of the pipeline: a module each."""
