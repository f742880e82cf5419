"""Text to syntax tree; knows neither evaluation nor robots."""
