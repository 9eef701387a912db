//! The program `mist`.

fn main() -> std::process::ExitCode {
    mist_server::main()
}
