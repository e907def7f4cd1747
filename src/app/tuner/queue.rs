//! What waits for the worker: of each kind only the newest.

use std::sync::{Condvar, Mutex, PoisonError};

/// Things to be made, by kind. A newer thing of a kind takes the place of the one that waits.
#[derive(Debug)]
pub struct Newest<K, T> {
    waiting: Mutex<Waiting<K, T>>,
    bell: Condvar,
}

#[derive(Debug)]
struct Waiting<K, T> {
    things: Vec<(K, T)>,
    is_closed: bool,
}

impl<K, T> Default for Newest<K, T> {
    fn default() -> Self {
        Self {
            waiting: Mutex::new(Waiting {
                things: Vec::new(),
                is_closed: false,
            }),
            bell: Condvar::new(),
        }
    }
}

impl<K: PartialEq, T> Newest<K, T> {
    /// Lets a thing wait, in the place of an older one of its kind: it keeps that one's turn, so
    /// that a slider in motion does not hold up the other kinds for ever.
    pub fn put(&self, kind: K, thing: T) {
        let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        match waiting.things.iter_mut().find(|(known, _)| *known == kind) {
            Some((_, old)) => *old = thing,
            None => waiting.things.push((kind, thing)),
        }
        self.bell.notify_one();
    }

    /// The next thing; waits for one. `None` once nobody will put any more.
    pub fn take(&self) -> Option<(K, T)> {
        let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        loop {
            if waiting.is_closed {
                return None;
            }
            if !waiting.things.is_empty() {
                return Some(waiting.things.remove(0));
            }
            waiting = self
                .bell
                .wait(waiting)
                .unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Nobody wants anything any more.
    pub fn close(&self) {
        let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        waiting.is_closed = true;
        waiting.things.clear();
        self.bell.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    #[test]
    fn only_the_newest_of_a_kind_is_made_and_in_its_turn() {
        let queue = Newest::default();
        for (kind, thing) in [("now", 1), ("a", 2), ("now", 3), ("b", 4), ("now", 5)] {
            queue.put(kind, thing);
        }
        let taken = [(); 3].map(|()| queue.take().unwrap());
        assert_eq!(taken, [("now", 5), ("a", 2), ("b", 4)]);
        queue.put("now", 6);
        assert_eq!(queue.take(), Some(("now", 6)));
    }

    #[test]
    fn whoever_waits_is_woken() {
        let queue: Arc<Newest<u8, u8>> = Arc::default();
        let worker = {
            let queue = queue.clone();
            std::thread::spawn(move || {
                std::iter::from_fn(|| queue.take())
                    .map(|(_, thing)| thing)
                    .collect::<Vec<_>>()
            })
        };
        queue.put(0, 7);
        while !queue.waiting.lock().unwrap().things.is_empty() {
            std::thread::yield_now();
        }
        queue.close();
        assert_eq!(worker.join().unwrap(), [7]);
    }

    #[test]
    fn what_waits_when_it_closes_is_not_made() {
        let queue = Newest::default();
        queue.put(0, 1);
        queue.close();
        assert_eq!(queue.take(), None);
    }
}
