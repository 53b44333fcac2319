//! The shell physics one element at a time: slow, short, and the twin that the fast kernels are tested against.
