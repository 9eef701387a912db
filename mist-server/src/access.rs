//! Access rules of the service besides keys; each is a flag of `mist serve`.

use std::net::SocketAddr;

/// Names, web pages and addresses that may use the service.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(next_help_heading = "Access")]
pub struct AccessOptions {
    /// Name or address by which clients call the service, besides loopback names and the address
    /// of --listen; may be repeated.
    #[arg(long = "host", value_name = "NAME")]
    pub hosts: Vec<String>,
    /// Origin of web pages that may use the service, such as `https://lab.example`; may be repeated.
    #[arg(long = "cors", value_name = "ORIGIN")]
    pub origins: Vec<String>,
    /// Listen beyond this machine without keys.
    #[arg(long)]
    pub open: bool,
    /// Take the address of a client from the last entry of `X-Forwarded-For`, which a proxy sets.
    #[arg(long)]
    pub trust_forwarded_for: bool,
}

impl AccessOptions {
    /// True if a listener beyond loopback has neither keys nor `--open`.
    pub(crate) fn is_exposed(&self, listen: &SocketAddr, has_keys: bool) -> bool {
        !(listen.ip().is_loopback() || has_keys || self.open)
    }
}
