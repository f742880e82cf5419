"""Brings URDF over to Yamaro: `yamaro migrate`."""
