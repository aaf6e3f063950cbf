"""Pressures of loaded teeth resolved patch by patch, edges included."""
