//! Renders a scene with RISE and believes only what it wrote.
//!
//! RISE ends with the same exit code after a good and after a failed render, and shows what it
//! could not read as black. So the pictures are removed first and must be there afterwards, and
//! some lines of its output are failures.

use std::{
    env, fs,
    io::Write,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::Instant,
};

use pictures::image::{Image, PictureFormat};

use crate::error::CommandError;

/// The picture at `path`, all of whose values are numbers.
pub(super) fn read(path: &Path) -> Result<Image, String> {
    let bytes = fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let image = Image::read(&bytes).map_err(|error| format!("{}: {error}", path.display()))?;
    if image.values().iter().any(|value| !value.is_finite()) {
        return Err(format!("{} has values that are not numbers", path.display()));
    }
    Ok(image)
}

/// The same, which must show something.
pub(super) fn seen(path: &Path) -> Result<Image, String> {
    let image = read(path)?;
    if image.values().iter().all(|value| *value == 0.0) {
        return Err(format!("{} is black", path.display()));
    }
    Ok(image)
}

/// The environment variable that names the program.
const VARIABLE: &str = "RISE_BIN";
/// The words that RISE prints when it goes on without something.
const FAILURES: [&str; 7] = [
    "derive diagnostic",
    "DataDrivenBSDF::",
    "Could not stat",
    "ailed to open",
    "unknown chunk type",
    "not declared in",
    "Material not found",
];

/// The program that renders.
pub(super) struct Renderer {
    program: PathBuf,
}

impl Renderer {
    /// The one that RISE_BIN names.
    pub(super) fn of_environment() -> Result<Self, CommandError> {
        let named = env::var_os(VARIABLE).filter(|name| !name.is_empty()).ok_or_else(|| {
            CommandError::Refused(format!("--render needs {VARIABLE} to name the program of RISE"))
        })?;
        let program = fs::canonicalize(&named).map_err(|error| {
            CommandError::Refused(format!("{VARIABLE} = {}: {error}", named.to_string_lossy()))
        })?;
        Ok(Self { program })
    }

    /// Renders `scene` in `folder`; all `images` must be new afterwards, and `judge` takes them.
    pub(super) fn render(
        &self,
        folder: &Path,
        scene: &str,
        images: &[String],
        judge: fn(&Path) -> Result<Image, String>,
    ) -> Result<String, CommandError> {
        let failed = |problem: String| CommandError::Failed(format!("{scene}: {problem}"));
        let folder = fs::canonicalize(folder).map_err(|error| failed(error.to_string()))?;
        if images.is_empty() {
            return Err(failed("it has no file_rasterizeroutput, so nothing would be seen".into()));
        }
        for image in images {
            match fs::remove_file(folder.join(image)) {
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                    return Err(failed(format!("the old {image} cannot be removed: {error}")));
                }
                _ => {}
            }
        }
        let started = Instant::now();
        let said = self.run(&folder, scene).map_err(|error| failed(error.to_string()))?;
        if let Some(line) = said.lines().find(|line| FAILURES.iter().any(|bad| line.contains(bad)))
        {
            return Err(failed(format!("RISE says: {}", line.trim())));
        }
        for image in images {
            let size = fs::metadata(folder.join(image)).map_or(0, |data| data.len());
            if size == 0 {
                return Err(failed(format!("RISE wrote no {image}")));
            }
            if PictureFormat::of_name(image).is_some() {
                judge(&folder.join(image)).map_err(&failed)?;
            }
        }
        let seconds = started.elapsed().as_secs_f64();
        Ok(format!("{scene}: {} in {seconds:.1} s\n", images.join(", ")))
    }

    fn run(&self, folder: &Path, scene: &str) -> std::io::Result<String> {
        let mut media = folder.as_os_str().to_owned();
        media.push("/");
        let mut child = Command::new(&self.program)
            .arg(scene)
            .current_dir(folder)
            .env("RISE_MEDIA_PATH", media)
            .env("RISE_OPTIONS_FILE", folder.join("rise.options"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()?;
        if let Some(mut input) = child.stdin.take() {
            // A program that reads nothing has gone; its pictures tell.
            let _ = input.write_all(b"render\nquit\n");
        }
        let output = child.wait_with_output()?;
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    }
}
