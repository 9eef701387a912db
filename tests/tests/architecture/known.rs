//! Faults that are known and may only become fewer. Each list goes when it is empty.

/// Modules in circles.
pub(crate) const MODULES_IN_CIRCLES: usize = 262;

/// Doc comments that do not begin with their subject.
pub(crate) const DOC_STARTS: usize = 703;

/// Type names that stand more than once.
pub(crate) const REPEATED_TYPES: &[&str] = &["Above", "Apertures", "Asked", "Axis", "Basis", "Beam", "Body", "Boundary", "Cell", "Circle", "Coherent", "Common", "Cone", "Drawing", "Element", "Film", "Frame", "Gathered", "Gaussian", "Generic", "Grid", "Harmonics", "Image", "Inside", "Interpolation", "Job", "Keys", "Kind", "Layer", "Layout", "Limit", "Lit", "Lobe", "Material", "Matrix", "Media", "Medium", "Memo", "Mixture", "Node", "Order", "Outcome", "Outgoing", "Outline", "Overlaid", "Pair", "Patch", "Path", "Pattern", "Place", "Placed", "Points", "Product", "Program", "Progress", "Ray", "Rayleigh", "Reader", "Response", "Rough", "Scalar", "Scope", "Series", "Several", "Shape", "Shelf", "Side", "Slab", "Slice", "Source", "Sphere", "Stack", "Step", "Sums", "Surface", "Surroundings", "Text", "Triangle", "Turn", "TwoLobes", "Unit", "Value", "Vectors", "Waiting", "Wave", "Work"];

/// Files above 500 lines.
pub(crate) const FILES_ABOVE_500: usize = 7;

/// Files above 400 lines; the end is 5.
pub(crate) const FILES_ABOVE_400: usize = 12;
