"""Elastic bodies in contact: condensed to the nodes that touch, with friction of our own."""
