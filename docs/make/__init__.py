"""What makes the documentation's generated pages and pictures: `python -m docs.make`."""
