"""Migrates URDF to Yamaro: `yamaro migrate`."""
