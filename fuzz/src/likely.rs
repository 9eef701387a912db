//! Generation of texts that resemble programs, so that most of them are parsed to the end.

/// Entries of VARIABLES: usual, unusual and wrong ones.
const ENTRIES: [&str; 16] = [
    "a = 1",
    "a=(1,2)",
    "b = \"a + 1\"",
    "#lambda = 0.5",
    "$c = \"\"",
    "$c = \"m 1\"",
    "a junk = 3",
    "= a = 4",
    "c = \"x;y\nz\"",
    "p=x=y",
    "q==2",
    "d =\n5",
    "\"e\" = 6",
    "END2 = 7",
    "f\t=\r\n8",
    "µ = 9",
];
/// Statements of VARY.
const LOOPS: [&str; 8] = [
    "FOR a FROM 0 TO 1 BY 1",
    "LIST list",
    "for a from \"0 + 0\" to (1) by 1",
    "LIST \"my list\"",
    "FOR #lambda\nFROM .4\nTO .7\nBY .1",
    "FOR rotation FROM a TO 2*a BY a",
    "LIST \"\"",
    "For A From 1 To 0 By -1",
];
/// Integrals.
const INTEGRALS: [&str; 8] = [
    "R = HEMI END",
    "C = CIRCLE CENTER=(0,0) ALPHA=1 END",
    "r=hemi inpol=(1,0,0,0) end",
    "D = DIFFERENTIAL CENTER = \"(1, 2)\" END",
    "P = POLYGON VERTEX=(0,1) VERTEX=(1,1) END",
    "A = ANNULUS OUTERALPHA=1 INNERALPHA=.5 ; note\n END",
    "C = CIRCLE END",
    "\"R\" = \"HEMI\" END",
];
/// Outputs, without their numbers.
const OUTPUTS: [&str; 8] =
    ["R", "l=R", "\"l x=R + 1\"", "=R", "\"=R\"", "\"\"", "l==R", "\"a;b\nc\""];
/// Entries of FILES.
const FILES: [&str; 8] = [
    "results = r.dat",
    "header = \"\"",
    "header=\"two\nlines\"",
    "format = \"%g\\t\"",
    "basis = xyxy",
    "listing = \"\"",
    "samples=s",
    "HEADER = END2",
];
/// Entries of COLOR.
const COLOR: [&str; 8] = [
    "table = t.mtab",
    "spectrum = R",
    "spectrum = \"R,R ,R, R\"",
    "patch = circle 2",
    "wavelength = a",
    "filter = linear(0)",
    "filter = \"linear(0) retarder(0,1)\"",
    "patch = point ; note",
];
/// Separators between two entries.
const BLANKS: [&str; 8] =
    ["\n", " ", "\n\n", " ; note\n", "\n; own line\n", "\r\n", "\t\n", "\n;\n;;\n"];

/// A text with the sections of a program. Each byte chooses an entry and its separator; 255 begins
/// the next section.
pub fn program(bytes: &[u8]) -> String {
    let mut sections = bytes.split(|byte| *byte == u8::MAX);
    let mut section = |known: &[&str], number: bool| -> String {
        let chosen = sections.next().unwrap_or_default().iter().enumerate();
        chosen
            .map(|(at, byte)| {
                let entry = known[usize::from(*byte) % known.len()];
                let blank = BLANKS[usize::from(*byte) / 16 % BLANKS.len()];
                if number {
                    format!("{} {entry}{blank}", at + 1)
                } else {
                    format!("{entry}{blank}")
                }
            })
            .collect()
    };
    let (variables, loops) = (section(&ENTRIES, false), section(&LOOPS, false));
    let (integrals, outputs) = (section(&INTEGRALS, false), section(&OUTPUTS, true));
    let (files, color) = (section(&FILES, false), section(&COLOR, false));
    let color = if color.is_empty() { color } else { format!("COLOR: {color} END") };
    format!(
        "MODEL = M\nVARIABLES: minsamples=1 differential=1 incidentangle=0 incidentpol=(1,0,0,0) \
         rotation=0 {variables} END\nVARY: {loops} END INTEGRALS: {integrals} END\n\
         OUTPUTS: {outputs} END FILES: {files} END {color}"
    )
}
