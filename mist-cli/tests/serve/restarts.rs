//! A service that ends in the middle of its work, and starts again.

use std::{
    io::{Read, Write},
    process::Command,
};

use crate::service::Service;

/// A job of some seconds with many steps: what is done is written down five times a second.
pub(crate) const LONG: &str = "MODEL = Facet_BRDF_Model\nVARIABLES:\n\
    rad = atan(1)/45 t = 0 incidentangle = t*rad incidentpol = (1,0.2,0.1,0) rotation = 0\n\
    integrationmode = 2 differential = (0.35*rad)^2 minsamples = 100 END\n\
    VARY:\nFOR t FROM 0 TO 80 BY 0.1\nEND\nINTEGRALS: R = HEMI END END\nOUTPUTS: 1 R END\n\
    FILES: format = %.17g\\t END\n";

#[test]
fn a_job_that_was_killed_in_the_middle_goes_on_to_the_table_of_an_undisturbed_run() {
    let data = tempfile::tempdir().unwrap();
    let mut service = Service::start(data.path(), &[]);
    let id = service.submit(LONG);
    service.wait(&id, |status| status["progress"].as_f64().unwrap() > 0.3);
    // SIGKILL: nothing can be tidied up.
    service.process.kill().unwrap();
    service.process.wait().unwrap();
    let service = Service::start(data.path(), &[]);
    let disturbed = service.results(&id);
    let status = service.wait(&id, |_| true);
    assert!(status["resumed_after"].as_u64().unwrap_or(0) > 0, "{status}");
    let undisturbed = service.results(&service.submit(LONG));
    assert!(disturbed == undisturbed, "the tables differ");
}

#[cfg(unix)]
#[test]
fn a_service_that_is_asked_to_stop_keeps_what_its_job_has_done() {
    let data = tempfile::tempdir().unwrap();
    let mut service = Service::start(data.path(), &[]);
    let put = r#"{"model":"Lambertian_BRDF_Model"}"#;
    assert_eq!(service.ask("PUT", "/v1/materials/white", put).0, 201);
    let id = service.submit(LONG);
    service.wait(&id, |status| status["progress"].as_f64().unwrap() > 0.1);
    stop(&mut service);
    let service = Service::start(data.path(), &[]);
    assert!(service.ask("GET", "/v1/materials", "").1.contains("white"));
    service.results(&id);
    assert!(service.wait(&id, |_| true)["resumed_after"].as_u64().unwrap() > 0);
}

/// Asks the service to stop and waits until it has.
#[cfg(unix)]
fn stop(service: &mut Service) {
    let kill = Command::new("kill").arg(service.process.id().to_string()).status().unwrap();
    assert!(kill.success());
    assert!(service.process.wait().unwrap().success());
}

#[cfg(unix)]
#[test]
fn a_service_that_stops_ends_the_events_of_a_job_that_runs() {
    let data = tempfile::tempdir().unwrap();
    let mut service = Service::start(data.path(), &[]);
    // Longer than a service that stops waits for its answers.
    let id = service.submit(&LONG.replace("(0.35*rad)^2", "(0.1*rad)^2"));
    service.wait(&id, |status| status["state"] == "running");
    let mut stream = service.connect();
    write!(stream, "GET /v1/jobs/{id}/events HTTP/1.1\r\nHost: localhost\r\n\r\n").unwrap();
    let mut begin = [0; 16];
    stream.read_exact(&mut begin).unwrap();
    stop(&mut service);
    let mut rest = Vec::new();
    stream.read_to_end(&mut rest).unwrap();
    // The last chunk: an answer that was cut off does not have it.
    assert!(rest.ends_with(b"\r\n0\r\n\r\n"), "{}", String::from_utf8_lossy(&rest));
}
