//! Files that are computed once for everybody who asks at the same time, and kept for the next.

use std::{
    collections::HashMap,
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, Instant},
};

use axum::body::Bytes;
use tokio::sync::watch;

use super::problem::Problem;

/// How long a failure is told to those who ask again.
const FAILURE_KEPT: Duration = Duration::from_secs(60);

/// What came out: a text, or why there is none.
pub(super) type Outcome = Result<Bytes, Problem>;

/// Texts by the names of what they are made from.
#[derive(Clone)]
pub(super) struct Flights {
    most: usize,
    board: Arc<Mutex<Board>>,
}

#[derive(Default)]
struct Board {
    clock: u64,
    bytes: usize,
    flights: HashMap<String, Flight>,
}

struct Flight {
    number: u64,
    used: u64,
    outcome: watch::Receiver<Option<Outcome>>,
    cancel: Arc<AtomicBool>,
    /// How many await it now.
    waiting: usize,
    /// Whether somebody was told to come back for it.
    promised: bool,
    /// Bytes of the text, once it is there.
    bytes: usize,
    failed: Option<Instant>,
}

/// Somebody who waits for a text; the work stops when nobody waits and nobody was promised it.
pub(super) struct Waiting {
    flights: Flights,
    key: String,
    number: u64,
    outcome: watch::Receiver<Option<Outcome>>,
}

/// Where the text goes that a flight is to compute.
pub(super) struct Landing {
    flights: Flights,
    key: String,
    number: u64,
    outcome: watch::Sender<Option<Outcome>>,
    /// Becomes true when nobody wants the text any more.
    pub(super) cancel: Arc<AtomicBool>,
}

impl Flights {
    /// Keeps texts of up to `most` bytes together.
    pub(super) fn new(most: usize) -> Self {
        Self { most, board: Arc::default() }
    }

    /// Bytes of the texts that are kept.
    pub(super) fn bytes(&self) -> usize {
        self.board().bytes
    }

    /// The flight for `key`, and where its text is to go if it has to be computed now.
    pub(super) fn join(&self, key: &str) -> (Waiting, Option<Landing>) {
        let mut board = self.board();
        board.clock += 1;
        let clock = board.clock;
        let stale = board.flights.get(key).is_some_and(|flight| {
            flight.failed.is_some_and(|failed| failed.elapsed() > FAILURE_KEPT)
        });
        if stale {
            board.flights.remove(key);
        }
        let waiting = |number, outcome| Waiting {
            flights: self.clone(),
            key: key.to_owned(),
            number,
            outcome,
        };
        if let Some(flight) = board.flights.get_mut(key) {
            flight.used = clock;
            flight.waiting += 1;
            return (waiting(flight.number, flight.outcome.clone()), None);
        }
        let (sender, outcome) = watch::channel(None);
        let cancel = Arc::new(AtomicBool::new(false));
        let flight = Flight {
            number: clock,
            used: clock,
            outcome: outcome.clone(),
            cancel: cancel.clone(),
            waiting: 1,
            promised: false,
            bytes: 0,
            failed: None,
        };
        board.flights.insert(key.to_owned(), flight);
        let landing = Landing {
            flights: self.clone(),
            key: key.to_owned(),
            number: clock,
            outcome: sender,
            cancel,
        };
        (waiting(clock, outcome), Some(landing))
    }

    fn board(&self) -> MutexGuard<'_, Board> {
        self.board.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Waiting {
    /// The text, if it is there within `patience`; else it goes on being computed for whoever
    /// comes back.
    pub(super) async fn outcome(&mut self, patience: Duration) -> Option<Outcome> {
        let wait = self.outcome.wait_for(Option::is_some);
        match tokio::time::timeout(patience, wait).await {
            Ok(Ok(outcome)) => return outcome.clone(),
            // The computation broke down and told nobody.
            Ok(Err(_)) => return None,
            Err(_) => {}
        }
        self.flight(|flight| flight.promised = true);
        None
    }

    fn flight(&self, change: impl FnOnce(&mut Flight)) {
        let mut board = self.flights.board();
        let own = board.flights.get_mut(&self.key).filter(|f| f.number == self.number);
        if let Some(flight) = own {
            change(flight);
        }
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        let mut board = self.flights.board();
        let own = board.flights.get_mut(&self.key).filter(|f| f.number == self.number);
        let Some(flight) = own else { return };
        flight.waiting -= 1;
        let is_wanted = flight.waiting > 0 || flight.promised || flight.outcome.borrow().is_some();
        if !is_wanted {
            flight.cancel.store(true, Ordering::Relaxed);
            board.flights.remove(&self.key);
        }
    }
}

impl Landing {
    /// Tells the outcome to everybody, and keeps it.
    pub(super) fn land(self, outcome: Outcome) {
        let mut board = self.flights.board();
        let own = board.flights.get_mut(&self.key).filter(|f| f.number == self.number);
        if let Some(flight) = own {
            match &outcome {
                Ok(text) => flight.bytes = text.len(),
                Err(_) => flight.failed = Some(Instant::now()),
            }
            board.bytes += outcome.as_ref().map_or(0, Bytes::len);
            // What the service could not do now it may do for the next who asks.
            if outcome.as_ref().is_err_and(|problem| problem.status >= 500) {
                board.flights.remove(&self.key);
            }
        }
        self.outcome.send_replace(Some(outcome));
        board.make_room(self.flights.most);
    }
}

impl Drop for Landing {
    fn drop(&mut self) {
        if self.outcome.borrow().is_some() {
            return;
        }
        let mut board = self.flights.board();
        if board.flights.get(&self.key).is_some_and(|f| f.number == self.number) {
            board.flights.remove(&self.key);
        }
    }
}

impl Board {
    /// Forgets the texts that were used longest ago until the rest fits into `most` bytes.
    fn make_room(&mut self, most: usize) {
        while self.bytes > most {
            // The order of the map does not matter: no two flights were used at the same time.
            let landed = self.flights.iter().filter(|(_, flight)| flight.bytes > 0);
            let oldest = landed.min_by_key(|(_, flight)| flight.used);
            let Some(key) = oldest.map(|(key, _)| key.clone()) else { break };
            self.bytes -= self.flights.remove(&key).map_or(0, |flight| flight.bytes);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOON: Duration = Duration::from_millis(1);

    #[tokio::test]
    async fn a_text_is_computed_once_for_all_who_ask() {
        let flights = Flights::new(100);
        let (mut first, landing) = flights.join("a");
        let (mut second, other) = flights.join("a");
        assert!(other.is_none());
        landing.unwrap().land(Ok(Bytes::from_static(b"text")));
        assert_eq!(first.outcome(SOON).await.unwrap().unwrap(), "text");
        assert_eq!(second.outcome(SOON).await.unwrap().unwrap(), "text");
        drop((first, second));
        assert!(flights.join("a").1.is_none());
    }

    #[tokio::test]
    async fn work_that_nobody_awaits_stops_unless_it_was_promised() {
        let flights = Flights::new(100);
        let (gone, landing) = flights.join("a");
        drop(gone);
        assert!(landing.unwrap().cancel.load(Ordering::Relaxed));
        let (mut patient, landing) = flights.join("a");
        assert!(patient.outcome(SOON).await.is_none());
        drop(patient);
        let landing = landing.unwrap();
        assert!(!landing.cancel.load(Ordering::Relaxed));
        landing.land(Ok(Bytes::from_static(b"text")));
        assert!(flights.join("a").0.outcome(SOON).await.is_some());
    }

    #[tokio::test]
    async fn what_was_used_longest_ago_makes_room() {
        let flights = Flights::new(10);
        for key in ["a", "b", "c"] {
            flights.join(key).1.unwrap().land(Ok(Bytes::from_static(b"12345")));
        }
        assert_eq!(flights.bytes(), 10);
        assert!(flights.join("a").1.is_some());
        assert!(flights.join("c").1.is_none());
    }
}
