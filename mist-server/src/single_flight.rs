//! Values that are computed once for all who ask for them at the same time, and kept for later.

use std::{
    collections::HashMap,
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, Instant},
};

use tokio::sync::watch;

/// Time for which a failure is the answer to those who ask again.
const FAILURE_KEPT: Duration = Duration::from_secs(60);

/// Time after which a promised value is not computed on if no client has asked again: some times
/// that of `Retry-After`.
const PROMISE_KEPT: Duration = Duration::from_secs(10);

/// Computations and their results by key; clones share them.
pub(crate) struct SingleFlight<T, E> {
    max_weight: usize,
    table: Arc<Mutex<FlightTable<T, E>>>,
}

struct FlightTable<T, E> {
    clock: u64,
    weight: usize,
    entries: HashMap<String, FlightEntry<T, E>>,
}

struct FlightEntry<T, E> {
    number: u64,
    last_used: u64,
    result: watch::Receiver<Option<Result<T, E>>>,
    cancel: Arc<AtomicBool>,
    subscribers: usize,
    /// Time at which the last client left that was told to come back for the value.
    promised_at: Option<Instant>,
    /// Weight of the value, once it is there.
    weight: usize,
    failed_at: Option<Instant>,
}

/// A client that waits for a value. The computation is cancelled when nobody waits for it and it
/// was promised to nobody.
pub(crate) struct Subscriber<T, E> {
    flights: SingleFlight<T, E>,
    key: String,
    number: u64,
    result: watch::Receiver<Option<Result<T, E>>>,
}

/// The side of a computation that publishes its result.
pub(crate) struct Producer<T, E> {
    flights: SingleFlight<T, E>,
    key: String,
    number: u64,
    result: watch::Sender<Option<Result<T, E>>>,
    /// Becomes true when nobody wants the value any more.
    pub(crate) cancel: Arc<AtomicBool>,
}

impl<T, E> Clone for SingleFlight<T, E> {
    fn clone(&self) -> Self {
        Self { max_weight: self.max_weight, table: self.table.clone() }
    }
}

impl<T, E> SingleFlight<T, E> {
    /// Keeps values whose weights add up to at most `max_weight`.
    pub(crate) fn new(max_weight: usize) -> Self {
        let table = FlightTable { clock: 0, weight: 0, entries: HashMap::new() };
        Self { max_weight, table: Arc::new(Mutex::new(table)) }
    }

    /// Weight of the values that are kept.
    pub(crate) fn weight(&self) -> usize {
        self.table().weight
    }

    /// Subscribes to the value of `key`; gives a producer too if the value has to be computed now.
    pub(crate) fn join(&self, key: &str) -> (Subscriber<T, E>, Option<Producer<T, E>>) {
        let mut table = self.table();
        table.clock += 1;
        let clock = table.clock;
        let is_stale = table.entries.get(key).is_some_and(|entry| {
            entry.failed_at.is_some_and(|failed| failed.elapsed() > FAILURE_KEPT)
        });
        if is_stale {
            table.entries.remove(key);
        }
        let subscriber = |number, result| Subscriber {
            flights: self.clone(),
            key: key.to_owned(),
            number,
            result,
        };
        if let Some(entry) = table.entries.get_mut(key) {
            entry.last_used = clock;
            entry.subscribers += 1;
            return (subscriber(entry.number, entry.result.clone()), None);
        }
        let (sender, result) = watch::channel(None);
        let cancel = Arc::new(AtomicBool::new(false));
        let entry = FlightEntry {
            number: clock,
            last_used: clock,
            result: result.clone(),
            cancel: cancel.clone(),
            subscribers: 1,
            promised_at: None,
            weight: 0,
            failed_at: None,
        };
        table.entries.insert(key.to_owned(), entry);
        let producer = Producer {
            flights: self.clone(),
            key: key.to_owned(),
            number: clock,
            result: sender,
            cancel,
        };
        (subscriber(clock, result), Some(producer))
    }

    fn table(&self) -> MutexGuard<'_, FlightTable<T, E>> {
        self.table.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T: Clone, E: Clone> Subscriber<T, E> {
    /// The result if it is there within `patience`; else it is promised to the client, and its
    /// computation goes on.
    pub(crate) async fn wait(&mut self, patience: Duration) -> Option<Result<T, E>> {
        let wait = self.result.wait_for(Option::is_some);
        match tokio::time::timeout(patience, wait).await {
            Ok(Ok(result)) => return result.clone(),
            // The producer was dropped without a result.
            Ok(Err(_)) => return None,
            Err(_) => {}
        }
        let mut table = self.flights.table();
        if let Some(entry) = table.entry(&self.key, self.number) {
            entry.promised_at = Some(Instant::now());
        }
        None
    }
}

impl<T, E> Drop for Subscriber<T, E> {
    fn drop(&mut self) {
        let mut table = self.flights.table();
        let Some(entry) = table.entry(&self.key, self.number) else { return };
        entry.subscribers -= 1;
        if let Some(promised_at) = &mut entry.promised_at {
            *promised_at = Instant::now();
        }
        let is_wanted =
            entry.subscribers > 0 || entry.promised_at.is_some() || entry.result.borrow().is_some();
        if !is_wanted {
            entry.cancel.store(true, Ordering::Relaxed);
            table.entries.remove(&self.key);
        }
    }
}

impl<T, E> Producer<T, E> {
    /// Waits until nobody has asked for the promised value for [`PROMISE_KEPT`].
    pub(crate) async fn abandoned(&self) {
        loop {
            tokio::time::sleep(PROMISE_KEPT / 10).await;
            let mut table = self.flights.table();
            let is_awaited = table.entry(&self.key, self.number).is_some_and(|entry| {
                let is_fresh = |at: Instant| at.elapsed() < PROMISE_KEPT;
                entry.subscribers > 0 || entry.promised_at.is_none_or(is_fresh)
            });
            if !is_awaited {
                return;
            }
        }
    }

    /// Gives the result to all subscribers. A value of this `weight` is kept, and so is a failure
    /// if `keep_failure`.
    pub(crate) fn publish(self, result: Result<T, E>, weight: usize, keep_failure: bool) {
        let mut table = self.flights.table();
        if let Some(entry) = table.entry(&self.key, self.number) {
            if result.is_ok() {
                entry.weight = weight;
                table.weight += weight;
            } else {
                entry.failed_at = Some(Instant::now());
                if !keep_failure {
                    table.entries.remove(&self.key);
                }
            }
        }
        self.result.send_replace(Some(result));
        table.make_room(self.flights.max_weight);
    }
}

impl<T, E> Drop for Producer<T, E> {
    fn drop(&mut self) {
        if self.result.borrow().is_some() {
            return;
        }
        let mut table = self.flights.table();
        if table.entry(&self.key, self.number).is_some() {
            table.entries.remove(&self.key);
        }
    }
}

impl<T, E> FlightTable<T, E> {
    /// The entry of `key`, unless a later computation has taken its place.
    fn entry(&mut self, key: &str, number: u64) -> Option<&mut FlightEntry<T, E>> {
        self.entries.get_mut(key).filter(|entry| entry.number == number)
    }

    /// Removes the least recently used values until the rest weighs at most `max_weight`.
    fn make_room(&mut self, max_weight: usize) {
        while self.weight > max_weight {
            // The order of the map does not matter: no two entries were used at the same time.
            let values = self.entries.iter().filter(|(_, entry)| entry.weight > 0);
            let oldest = values.min_by_key(|(_, entry)| entry.last_used);
            let Some(key) = oldest.map(|(key, _)| key.clone()) else { break };
            self.weight -= self.entries.remove(&key).map_or(0, |entry| entry.weight);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOON: Duration = Duration::from_millis(1);

    type Flights = SingleFlight<&'static str, ()>;

    #[tokio::test]
    async fn a_value_is_computed_once_for_all_subscribers() {
        let flights = Flights::new(100);
        let (mut first, producer) = flights.join("a");
        let (mut second, other) = flights.join("a");
        assert!(other.is_none());
        producer.unwrap().publish(Ok("text"), 4, true);
        assert_eq!(first.wait(SOON).await, Some(Ok("text")));
        assert_eq!(second.wait(SOON).await, Some(Ok("text")));
        drop((first, second));
        assert!(flights.join("a").1.is_none());
    }

    #[tokio::test]
    async fn a_computation_without_subscribers_is_cancelled_unless_promised() {
        let flights = Flights::new(100);
        let (gone, producer) = flights.join("a");
        drop(gone);
        assert!(producer.unwrap().cancel.load(Ordering::Relaxed));
        let (mut patient, producer) = flights.join("a");
        assert!(patient.wait(SOON).await.is_none());
        drop(patient);
        let producer = producer.unwrap();
        assert!(!producer.cancel.load(Ordering::Relaxed));
        producer.publish(Ok("text"), 4, true);
        assert!(flights.join("a").0.wait(SOON).await.is_some());
    }

    #[tokio::test]
    async fn a_failure_is_kept_only_if_its_producer_says_so() {
        let flights = Flights::new(100);
        flights.join("kept").1.unwrap().publish(Err(()), 0, true);
        flights.join("again").1.unwrap().publish(Err(()), 0, false);
        assert!(flights.join("kept").1.is_none());
        assert!(flights.join("again").1.is_some());
    }

    #[tokio::test]
    async fn the_least_recently_used_value_makes_room() {
        let flights = Flights::new(10);
        for key in ["a", "b", "c"] {
            flights.join(key).1.unwrap().publish(Ok("12345"), 5, true);
        }
        assert_eq!(flights.weight(), 10);
        assert!(flights.join("a").1.is_some());
        assert!(flights.join("c").1.is_none());
    }
}
