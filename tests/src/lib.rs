//! Tests of the whole workspace: conformance programs, reference vectors, the binary and the service.
