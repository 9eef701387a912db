//! Reflection and transmission coefficients of film stacks.
