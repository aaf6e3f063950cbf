"""Contact on the faces that are near, compiled as a whole: for many bodies and many steps."""
