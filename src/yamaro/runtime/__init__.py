"""Syntax tree to output tree; knows no robots."""
