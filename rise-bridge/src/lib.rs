//! Materials and tables in the formats of renderers.
