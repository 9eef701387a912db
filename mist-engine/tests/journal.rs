//! A run that was interrupted goes on from its journal, to the same texts.

use std::{
    collections::BTreeMap,
    io,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use mist_engine::{
    Control, Failure, Job, Journal, MemoryFiles, MemorySink, Options, StepResult, compile,
};

/// Keeps steps in memory, and stops the run behind so many.
#[derive(Default)]
struct Paper {
    steps: BTreeMap<u64, StepResult>,
    recalled: u64,
    stop_behind: usize,
    cancel: Arc<AtomicBool>,
}

impl Journal for Paper {
    fn recall(&mut self, step: u64) -> io::Result<Option<StepResult>> {
        let found = self.steps.get(&step).cloned();
        self.recalled += u64::from(found.is_some());
        Ok(found)
    }

    fn keep(&mut self, first: u64, steps: &[StepResult]) -> io::Result<()> {
        self.steps.extend((first..).zip(steps.iter().cloned()));
        if self.steps.len() > self.stop_behind {
            self.cancel.store(true, Ordering::Relaxed);
        }
        Ok(())
    }
}

fn job(rest: &str) -> Job {
    let head = "MODEL = Facet_BRDF_Model\nVARIABLES:\n rad = atan(1)/45 t = 0 incidentangle = t*rad\n\
        incidentpol = (1,0,0,0) rotation = 0 differential = (4*rad)^2 minsamples = 10 END\n";
    let files = Arc::new(MemoryFiles::default());
    compile(&format!("{head}{rest}"), files, &Options::default())
        .unwrap_or_else(|found| panic!("{found:?}"))
}

/// Runs the program twice on one journal, the first time until it is stopped.
fn assert_goes_on(rest: &str) {
    let job = job(rest);
    let mut whole = MemorySink::default();
    job.run(&mut whole, &Control::default()).unwrap();
    let mut paper = Paper { stop_behind: 100, ..Paper::default() };
    let control = Control { cancel: paper.cancel.clone(), progress: None };
    let stopped = job.run_on(&mut MemorySink::default(), &control, &mut paper);
    assert!(matches!(stopped, Err(Failure::Cancelled)), "{stopped:?}");
    // A block that was kept in part is not different from one that was not begun.
    let last = *paper.steps.keys().next_back().unwrap();
    paper.steps.remove(&last);
    let before = paper.steps.len() as u64;
    paper.stop_behind = usize::MAX;
    let mut rest = MemorySink::default();
    job.run_on(&mut rest, &Control::default(), &mut paper).unwrap();
    assert_eq!((rest.results, rest.samples), (whole.results, whole.samples));
    assert_eq!(paper.recalled, before);
}

#[test]
fn independent_steps_are_not_evaluated_again() {
    assert_goes_on(
        "VARY:\nFOR t FROM 0 TO 80 BY 0.02\nEND\nINTEGRALS: R = HEMI END END\nOUTPUTS: 1 R END\n\
         FILES: END\n",
    );
}

#[test]
fn samples_come_out_of_the_journal() {
    assert_goes_on(
        "VARY:\nFOR t FROM 0 TO 80 BY 0.02\nEND\n\
         INTEGRALS: R = CIRCLE CENTER = (0,0) ALPHA = 10*deg END END\n\
         OUTPUTS: 1 R END\nFILES: samples = s.txt END\n",
    );
}

#[test]
fn apertures_that_read_integrals_read_those_of_the_journal() {
    assert_goes_on(
        "VARY:\nFOR t FROM 0 TO 80 BY 0.2\nEND\nINTEGRALS:\n\
         A = CIRCLE CENTER = (20*deg,0) ALPHA = 10*deg END\n\
         B = CIRCLE CENTER = (20*deg,A) ALPHA = (10+10*A)*deg END\nEND\n\
         OUTPUTS: 1 A 2 B END\nFILES: END\n",
    );
}
