//! Node-to-face contact between layers of fabric, with side memory and Coulomb friction.
