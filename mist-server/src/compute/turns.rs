//! Order in which computations begin: small ones first, the clients in turn.

use std::collections::{BTreeMap, VecDeque};

use tokio::sync::oneshot;

/// Estimated size of a computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum WorkSize {
    /// Well below a second.
    Small,
    /// Longer, or not known.
    Large,
}

/// Numbers of computations that are allowed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ComputeLimits {
    /// Of one size, of all clients, at the same time.
    pub(crate) running: usize,
    /// Of one size and of one client, at the same time.
    pub(crate) client_running: usize,
    /// Computations that wait, of all clients.
    pub(crate) waiting: usize,
    /// Computations of one size that wait, of one client.
    pub(crate) client_waiting: usize,
}

/// The reason why a computation may not even wait.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Crowded {
    /// Too many of all clients wait.
    Service,
    /// Too many of this client wait.
    Client,
}

/// The clients in the order of their turns, each with the computations that wait.
type ClientQueues = VecDeque<(String, VecDeque<oneshot::Sender<()>>)>;

/// Computations that run and wait.
#[derive(Debug)]
pub(super) struct Turns {
    limits: ComputeLimits,
    /// Numbers that run, by client and size.
    running: BTreeMap<(String, WorkSize), usize>,
    /// Those that wait, by size.
    waiting: BTreeMap<WorkSize, ClientQueues>,
}

impl Turns {
    pub(super) fn new(limits: ComputeLimits) -> Self {
        Self { limits, running: BTreeMap::new(), waiting: BTreeMap::new() }
    }

    /// Begins a computation, or puts it at the end of its queue; the receiver tells when it begins.
    pub(super) fn enter(
        &mut self,
        client: &str,
        size: WorkSize,
    ) -> Result<oneshot::Receiver<()>, Crowded> {
        self.forget_those_who_left();
        let (begin, begun) = oneshot::channel();
        let queues = self.waiting.entry(size).or_default();
        let own = queues.iter().position(|(name, _)| name == client);
        let own_length = own.map_or(0, |at| queues[at].1.len());
        let may_begin = own_length == 0 && self.has_place(client, size);
        if !may_begin && own_length >= self.limits.client_waiting {
            return Err(Crowded::Client);
        }
        if !may_begin && self.waiting() >= self.limits.waiting {
            return Err(Crowded::Service);
        }
        let queues = self.waiting.entry(size).or_default();
        match own {
            Some(at) => queues[at].1.push_back(begin),
            None => queues.push_back((client.to_owned(), VecDeque::from([begin]))),
        }
        self.begin_next();
        Ok(begun)
    }

    /// Counts a computation that ended, and begins those that have waited for it.
    pub(super) fn leave(&mut self, client: &str, size: WorkSize) {
        let key = (client.to_owned(), size);
        if let Some(count) = self.running.get_mut(&key) {
            *count -= 1;
            if *count == 0 {
                self.running.remove(&key);
            }
        }
        self.begin_next();
    }

    /// Counts a small computation as a large one because it takes long.
    pub(super) fn outgrow(&mut self, client: &str) {
        *self.running.entry((client.to_owned(), WorkSize::Large)).or_default() += 1;
        self.leave(client, WorkSize::Small);
    }

    /// Number of computations that run.
    pub(super) fn running(&self) -> usize {
        self.running.values().sum()
    }

    /// Number of computations that wait.
    pub(super) fn waiting(&self) -> usize {
        self.waiting.values().flatten().map(|(_, queue)| queue.len()).sum()
    }

    fn has_place(&self, client: &str, size: WorkSize) -> bool {
        let counts = self.running.iter().filter(|((_, of), _)| *of == size);
        let (mut all, mut own) = (0, 0);
        for ((name, _), count) in counts {
            all += count;
            own += if name == client { *count } else { 0 };
        }
        all < self.limits.running && own < self.limits.client_running
    }

    fn begin_next(&mut self) {
        for size in [WorkSize::Small, WorkSize::Large] {
            let mut queues = self.waiting.remove(&size).unwrap_or_default();
            let mut refused = 0;
            while refused < queues.len() {
                let Some((client, mut queue)) = queues.pop_front() else { break };
                if !self.has_place(&client, size) {
                    refused += 1;
                    queues.push_back((client, queue));
                    continue;
                }
                // A client that has left does not take a turn.
                let begun = std::iter::from_fn(|| queue.pop_front()).any(|b| b.send(()).is_ok());
                if begun {
                    refused = 0;
                    *self.running.entry((client.clone(), size)).or_default() += 1;
                }
                if !queue.is_empty() {
                    queues.push_back((client, queue));
                }
            }
            self.waiting.insert(size, queues);
        }
    }

    fn forget_those_who_left(&mut self) {
        for queues in self.waiting.values_mut() {
            for (_, queue) in queues.iter_mut() {
                queue.retain(|begin| !begin.is_closed());
            }
            queues.retain(|(_, queue)| !queue.is_empty());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: ComputeLimits =
        ComputeLimits { running: 2, client_running: 1, waiting: 5, client_waiting: 3 };

    fn has_begun(begun: &mut oneshot::Receiver<()>) -> bool {
        begun.try_recv().is_ok()
    }

    #[test]
    fn clients_take_turns_and_nobody_has_more_than_its_share() {
        let mut turns = Turns::new(LIMITS);
        let mut a: Vec<_> = (0..4).map(|_| turns.enter("a", WorkSize::Large).unwrap()).collect();
        assert_eq!(turns.enter("a", WorkSize::Large).unwrap_err(), Crowded::Client);
        let mut b = turns.enter("b", WorkSize::Large).unwrap();
        let mut c = turns.enter("c", WorkSize::Large).unwrap();
        assert!(has_begun(&mut a[0]) && has_begun(&mut b) && !has_begun(&mut c));
        turns.leave("a", WorkSize::Large);
        assert!(has_begun(&mut a[1]) || has_begun(&mut c));
        turns.leave("b", WorkSize::Large);
        assert!(!has_begun(&mut a[2]));
    }

    #[test]
    fn small_computations_do_not_wait_for_large_ones() {
        let mut turns = Turns::new(LIMITS);
        let _large: Vec<_> = (0..3).map(|_| turns.enter("a", WorkSize::Large).unwrap()).collect();
        assert!(has_begun(&mut turns.enter("a", WorkSize::Small).unwrap()));
        turns.outgrow("a");
        assert!(has_begun(&mut turns.enter("a", WorkSize::Small).unwrap()));
    }

    #[test]
    fn those_who_left_hold_no_place() {
        let mut turns = Turns::new(LIMITS);
        let _runs = turns.enter("a", WorkSize::Large).unwrap();
        for _ in 0..20 {
            drop(turns.enter("a", WorkSize::Large).unwrap());
        }
        let mut next = turns.enter("a", WorkSize::Large).unwrap();
        turns.leave("a", WorkSize::Large);
        assert!(has_begun(&mut next));
    }
}
