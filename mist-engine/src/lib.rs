//! Compiles MIST programs to jobs and runs them.
