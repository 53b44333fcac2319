//! Shells: membrane, hourglass control, viscosity, bending and follower pressure in one pass over the mesh.
