"""The element tree: reader, writer, and values as text."""
