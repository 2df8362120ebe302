//! How often a token may ask, and how often an address may fail to show one. Both remember a bounded number of callers.

use governor::clock::{Clock, DefaultClock};
use governor::middleware::NoOpMiddleware;
use governor::state::keyed::DashMapStateStore;
use governor::state::{InMemoryState, NotKeyed};
use governor::{Quota, RateLimiter as Governor};
use std::collections::HashMap;
use std::hash::Hash;
use std::net::IpAddr;
use std::num::NonZeroU32;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Most callers remembered one by one.
const CALLERS: usize = 1 << 16;

/// Callers who have been quiet for long are forgotten once in so many requests.
const TIDY_EVERY: u32 = 1024;

/// At most so many failures are needed between two sweeps over a full table.
const SWEEP_PAUSE: Duration = Duration::from_secs(1);

/// How often something may happen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rate {
    /// In the long run.
    pub per_minute: NonZeroU32,
    /// At once, after a quiet time.
    pub burst: NonZeroU32,
}

type Limiter<S, K, C> = Governor<K, S, C, NoOpMiddleware<<C as Clock>::Instant>>;

/// Limits requests per caller.
#[derive(Debug)]
pub struct RateLimiter<K: Hash + Eq + Clone, C: Clock = DefaultClock> {
    callers: Limiter<DashMapStateStore<K>, K, C>,
    // More callers than can be remembered share one allowance.
    crowd: Limiter<InMemoryState, NotKeyed, C>,
    clock: C,
    most: usize,
    requests: AtomicU32,
}

impl<K: Hash + Eq + Clone> RateLimiter<K> {
    /// A limiter that allows each caller `rate`.
    pub fn new(rate: Rate) -> Self {
        Self::with(rate, CALLERS, DefaultClock::default())
    }
}

impl<K: Hash + Eq + Clone, C: Clock + Clone> RateLimiter<K, C> {
    fn with(rate: Rate, most: usize, clock: C) -> Self {
        let quota = Quota::per_minute(rate.per_minute).allow_burst(rate.burst);
        let callers = Governor::dashmap_with_clock(quota, clock.clone());
        let crowd = Governor::direct_with_clock(quota, clock.clone());
        Self { callers, crowd, clock, most, requests: AtomicU32::new(0) }
    }

    /// Counts one request; an error says after how long the next one will be allowed.
    pub fn check(&self, caller: &K) -> Result<(), Duration> {
        if self.requests.fetch_add(1, Ordering::Relaxed) % TIDY_EVERY == TIDY_EVERY - 1 {
            self.callers.retain_recent();
            self.callers.shrink_to_fit();
        }
        let checked = if self.callers.len() < self.most { self.callers.check_key(caller) } else { self.crowd.check() };
        checked.map_err(|until| until.wait_time_from(self.clock.now()))
    }
}

/// Limits failed authentications per address: who fails too often is told to wait.
#[derive(Debug)]
pub struct FailureLimiter {
    interval: Duration,
    tolerance: Duration,
    most: usize,
    state: Mutex<Failures>,
}

#[derive(Debug)]
struct Failures {
    // When all of an address's failures will be forgiven. Each adds one interval (the generic cell rate algorithm).
    forgiven_at: HashMap<IpAddr, Instant>,
    swept_at: Instant,
}

impl FailureLimiter {
    /// A limiter that allows each address `rate` of failures.
    pub fn new(rate: Rate) -> Self {
        Self::with(rate, CALLERS, Instant::now())
    }

    fn with(rate: Rate, most: usize, now: Instant) -> Self {
        let interval = Duration::from_mins(1) / rate.per_minute.get();
        let tolerance = interval.saturating_mul(rate.burst.get() - 1);
        Self { interval, tolerance, most, state: Mutex::new(Failures { forgiven_at: HashMap::new(), swept_at: now }) }
    }

    /// Whether `address` may try; an error says after how long it may.
    pub fn check(&self, address: IpAddr) -> Result<(), Duration> {
        self.check_at(address, Instant::now())
    }

    /// Notes that `address` failed.
    pub fn record(&self, address: IpAddr) {
        self.record_at(address, Instant::now());
    }

    fn check_at(&self, address: IpAddr, now: Instant) -> Result<(), Duration> {
        let state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let forgiven_at = state.forgiven_at.get(&subscriber(address));
        let wait = forgiven_at.map_or(Duration::ZERO, |at| at.saturating_duration_since(now));
        let wait = wait.saturating_sub(self.tolerance);
        if wait.is_zero() { Ok(()) } else { Err(wait) }
    }

    fn record_at(&self, address: IpAddr, now: Instant) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let full = state.forgiven_at.len() >= self.most;
        if full && now.saturating_duration_since(state.swept_at) >= SWEEP_PAUSE {
            state.forgiven_at.retain(|_, at| *at > now);
            state.swept_at = now;
        }
        let (address, room) = (subscriber(address), state.forgiven_at.len() < self.most);
        match state.forgiven_at.get_mut(&address) {
            Some(at) => *at = (*at).max(now) + self.interval,
            None if room => drop(state.forgiven_at.insert(address, now + self.interval)),
            // So many addresses at once are one attacker's; guessing stays hopeless even unlimited.
            None => {}
        }
    }
}

/// Whom an address stands for: with IPv6 one subscriber has a whole /64.
fn subscriber(address: IpAddr) -> IpAddr {
    match address.to_canonical() {
        IpAddr::V4(address) => IpAddr::V4(address),
        IpAddr::V6(address) => IpAddr::V6((address.to_bits() & !u128::from(u64::MAX)).into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use governor::clock::FakeRelativeClock;

    const SECOND: Duration = Duration::from_secs(1);

    fn rate(per_minute: u32, burst: u32) -> Rate {
        Rate { per_minute: NonZeroU32::new(per_minute).unwrap(), burst: NonZeroU32::new(burst).unwrap() }
    }

    fn ip(text: &str) -> IpAddr {
        text.parse().unwrap()
    }

    #[test]
    fn each_caller_has_a_burst_and_then_a_steady_rate() {
        let clock = FakeRelativeClock::default();
        let limiter = RateLimiter::with(rate(60, 3), CALLERS, clock.clone());
        for caller in ["a", "b"] {
            assert_eq!([(); 4].map(|()| limiter.check(&caller)), [Ok(()), Ok(()), Ok(()), Err(SECOND)]);
        }
        clock.advance(SECOND / 4);
        assert_eq!(limiter.check(&"a"), Err(SECOND * 3 / 4));
        clock.advance(SECOND);
        assert_eq!([(); 2].map(|()| limiter.check(&"a").is_ok()), [true, false]);
        clock.advance(SECOND * 10);
        assert_eq!([(); 4].map(|()| limiter.check(&"a").is_ok()), [true, true, true, false]);
    }

    #[test]
    fn quiet_callers_are_forgotten_and_busy_ones_are_not() {
        let clock = FakeRelativeClock::default();
        let limiter = RateLimiter::with(rate(1, 1), CALLERS, clock.clone());
        for caller in 0..1000 {
            limiter.check(&caller).unwrap();
        }
        clock.advance(Duration::from_mins(2));
        limiter.check(&5000).unwrap();
        for _ in 1001..TIDY_EVERY {
            let _ = limiter.check(&5000);
        }
        assert_eq!(limiter.callers.len(), 1);
        assert!(limiter.check(&5000).is_err());
    }

    #[test]
    fn too_many_callers_share_one_allowance() {
        let limiter = RateLimiter::with(rate(60, 2), 10, FakeRelativeClock::default());
        let allowed = (0..1000).filter(|caller| limiter.check(caller).is_ok()).count();
        assert_eq!((allowed, limiter.callers.len()), (12, 10));
    }

    #[test]
    fn who_fails_too_often_has_to_wait() {
        let now = Instant::now();
        let limiter = FailureLimiter::with(rate(6, 3), CALLERS, now);
        let (guesser, other) = (ip("192.0.2.1"), ip("192.0.2.2"));
        for _ in 0..3 {
            assert_eq!(limiter.check_at(guesser, now), Ok(()));
            limiter.record_at(guesser, now);
        }
        assert_eq!(limiter.check_at(guesser, now), Err(SECOND * 10));
        assert_eq!(limiter.check_at(ip("::ffff:192.0.2.1"), now), Err(SECOND * 10));
        assert_eq!(limiter.check_at(other, now), Ok(()));
        assert_eq!(limiter.check_at(guesser, now + SECOND * 4), Err(SECOND * 6));
        let later = now + SECOND * 10;
        assert_eq!(limiter.check_at(guesser, later), Ok(()));
        limiter.record_at(guesser, later);
        assert_eq!(limiter.check_at(guesser, later), Err(SECOND * 10));
        assert_eq!(limiter.check_at(guesser, later + SECOND * 30), Ok(()));
    }

    #[test]
    fn moving_within_one_s_own_ipv6_network_does_not_help() {
        let now = Instant::now();
        let limiter = FailureLimiter::with(rate(6, 1), CALLERS, now);
        limiter.record_at(ip("2001:db8:1:2::1"), now);
        assert!(limiter.check_at(ip("2001:db8:1:2:ffff::9"), now).is_err());
        assert!(limiter.check_at(ip("2001:db8:1:3::1"), now).is_ok());
    }

    #[test]
    fn a_crowd_of_failures_does_not_fill_memory() {
        let now = Instant::now();
        let limiter = FailureLimiter::with(rate(60, 1), 10, now);
        let address = |n: u32| IpAddr::V4(n.into());
        (0..100).for_each(|n| limiter.record_at(address(n), now));
        assert_eq!(limiter.state.lock().unwrap().forgiven_at.len(), 10);
        assert!(limiter.check_at(address(5), now).is_err());
        limiter.record_at(address(200), now + SECOND * 2);
        assert_eq!(limiter.state.lock().unwrap().forgiven_at.len(), 1);
        assert!(limiter.check_at(address(200), now + SECOND * 2).is_err());
    }
}
