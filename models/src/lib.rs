//! Reduced-order virtual-work models of pneumatic bending actuators.
