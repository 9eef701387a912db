//! Faults that are known and may only become fewer. Each list goes when it is empty.

/// Modules in circles.
pub(crate) const MODULES_IN_CIRCLES: usize = 282;

/// Doc comments that do not begin with their subject.
pub(crate) const DOC_STARTS: usize = 838;

/// Type names that stand more than once.
pub(crate) const REPEATED_TYPES: &[&str] = &["Angles", "Apertures", "Asked", "Axes", "Axis", "Basis", "Beam", "Block", "Body", "Boundary", "Case", "Cell", "Chunk", "Circle", "Coherent", "Columns", "Common", "Comparison", "Cone", "Document", "Drawing", "Element", "Field", "Fields", "Film", "Filter", "Form", "Frame", "Gathered", "Gaussian", "Generic", "Grid", "Harmonics", "Head", "Image", "Inside", "Interpolation", "Job", "Keys", "Kind", "Lamp", "Layer", "Layout", "Limit", "Line", "Lit", "Lobe", "Material", "Matrix", "Media", "Medium", "Memo", "Method", "Mixture", "Mueller", "Name", "Named", "Node", "Order", "Outcome", "Outgoing", "Outline", "Overlaid", "Pair", "Patch", "Path", "Pattern", "Place", "Placed", "Points", "Product", "Program", "Progress", "Quirk", "Ray", "Rayleigh", "Read", "Reader", "Response", "Role", "Rough", "Row", "Rows", "Scalar", "Scope", "Seen", "Series", "Several", "Shape", "Shelf", "Side", "Slab", "Slice", "Source", "Spectra", "Sphere", "Spread", "Stack", "Step", "Stop", "Sums", "Surface", "Surroundings", "Table", "Text", "Triangle", "Turn", "TwoLobes", "Unit", "Value", "Values", "Variable", "Vectors", "Waiting", "Wave", "Weights", "Work", "Written"];

/// Files above 500 lines.
pub(crate) const FILES_ABOVE_500: usize = 7;

/// Files above 400 lines; the end is 5.
pub(crate) const FILES_ABOVE_400: usize = 14;
