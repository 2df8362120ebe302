//! NSGA-II: a population that spreads along the front of candidates that no other beats in everything.
//!
//! Ranks by constrained domination, then by crowding distance; parents by binary tournament, children by simulated binary crossing and
//! polynomial mutation within the unit cube. Source: Deb, Pratap, Agarwal and Meyarivan (2002); indices 15 and 20 as they have them. The
//! state is a value: children follow from it and a stream of random numbers, so it can be stored and taken up anywhere.

use super::stream::Stream;
use crate::scalar::power;
use serde::{Deserialize, Serialize};

/// Distribution indices of crossing and of mutation.
const CROSSING: f64 = 15.0;
const MUTATION: f64 = 20.0;
/// Share of pairs that cross.
const CROSSED: f64 = 0.9;

/// A candidate with what it is worth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Member {
    /// Point of the unit cube.
    pub point: Vec<f64>,
    /// What should be small.
    pub objectives: Vec<f64>,
    /// By how much limits are exceeded; 0 where all are kept.
    pub violation: f64,
    /// Generation in which it was tried.
    pub generation: u32,
}

/// A search under way.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Nsga {
    /// Members that are kept.
    pub population: usize,
    /// The best so far, the best first.
    pub members: Vec<Member>,
}

impl Nsga {
    /// Before its first generation.
    pub fn new(population: usize) -> Self {
        Self { population, members: Vec::new() }
    }

    /// Whether its parts fit together.
    pub fn is_sound(&self, dimension: usize, objectives: usize) -> bool {
        let fits = |member: &Member| {
            member.point.len() == dimension
                && member.objectives.len() == objectives
                && member.point.iter().all(|x| (0.0..=1.0).contains(x))
                && member.objectives.iter().chain([&member.violation]).all(|x| x.is_finite())
        };
        self.members.len() <= self.population && self.members.iter().all(fits)
    }

    /// The next candidates: anywhere at first (where there is but the start), then children.
    pub fn ask(&self, dimension: usize, stream: &mut Stream) -> Vec<Vec<f64>> {
        let mut points = Vec::with_capacity(self.population + 1);
        if self.members.len() < 2 {
            points.extend((0..self.population).map(|_| (0..dimension).map(|_| stream.unit()).collect()));
            return points;
        }
        while points.len() < self.population {
            let [mut a, mut b] = [(); 2].map(|()| self.tournament(stream).point.clone());
            cross(&mut a, &mut b, stream);
            for child in [&mut a, &mut b] {
                mutate(child, stream);
            }
            points.extend([a, b]);
        }
        points.truncate(self.population);
        points
    }

    /// The better of two; members are in order.
    fn tournament(&self, stream: &mut Stream) -> &Member {
        let [a, b] = [(); 2].map(|()| stream.below(self.members.len()));
        &self.members[a.min(b)]
    }

    /// Takes in candidates and keeps the best of all.
    pub fn tell(&mut self, tried: Vec<Member>) {
        let mut all = std::mem::take(&mut self.members);
        all.extend(tried);
        let mut order = Vec::with_capacity(all.len());
        for mut front in fronts(&all) {
            let distance = crowding(&all, &front);
            // Members apart from others first; of equals the older one.
            let place = |n: &usize| front.iter().position(|m| m == n).map_or(0.0, |place| distance[place]);
            let keys: Vec<_> = front.iter().map(place).collect();
            let mut sorted: Vec<_> = front.drain(..).zip(keys).collect();
            sorted.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
            order.extend(sorted.into_iter().map(|(n, _)| n));
        }
        order.truncate(self.population);
        let mut members: Vec<_> = all.into_iter().map(Some).collect();
        self.members = order.into_iter().filter_map(|n| members[n].take()).collect();
    }

    /// Members that keep all limits and that no other beats, by their first objective.
    pub fn front(&self) -> Vec<&Member> {
        let kept: Vec<_> = self.members.iter().filter(|member| member.violation == 0.0).collect();
        let mut front: Vec<_> = kept.iter().filter(|a| !kept.iter().any(|b| dominates(b, a))).copied().collect();
        front.sort_by(|a, b| a.objectives.iter().zip(&b.objectives).fold(std::cmp::Ordering::Equal, |order, (a, b)| order.then(a.total_cmp(b))));
        front.dedup_by(|a, b| a.objectives == b.objectives);
        front
    }
}

/// Whether `a` is better: it exceeds limits by less, or both keep them and it is nowhere worse and somewhere better.
fn dominates(a: &Member, b: &Member) -> bool {
    if a.violation != b.violation {
        return a.violation < b.violation;
    }
    let pairs = || a.objectives.iter().zip(&b.objectives);
    pairs().all(|(a, b)| a <= b) && pairs().any(|(a, b)| a < b)
}

/// Members by rank: each front is beaten only by those before it.
fn fronts(members: &[Member]) -> Vec<Vec<usize>> {
    let mut beaten_by: Vec<usize> =
        members.iter().map(|a| members.iter().filter(|b| dominates(b, a)).count()).collect();
    let mut fronts = Vec::new();
    let mut current: Vec<usize> = (0..members.len()).filter(|n| beaten_by[*n] == 0).collect();
    while !current.is_empty() {
        let mut next = Vec::new();
        for best in &current {
            for n in 0..members.len() {
                if dominates(&members[*best], &members[n]) {
                    beaten_by[n] -= 1;
                    if beaten_by[n] == 0 {
                        next.push(n);
                    }
                }
            }
        }
        next.sort_unstable();
        fronts.push(std::mem::replace(&mut current, next));
    }
    fronts
}

/// Crowding distance of each member of a front: infinite at its ends.
fn crowding(members: &[Member], front: &[usize]) -> Vec<f64> {
    let mut distance = vec![0.0; front.len()];
    let objectives = front.first().map_or(0, |n| members[*n].objectives.len());
    for objective in 0..objectives {
        let value = |place: usize| members[front[place]].objectives[objective];
        let mut places: Vec<_> = (0..front.len()).collect();
        places.sort_by(|a, b| value(*a).total_cmp(&value(*b)).then(a.cmp(b)));
        let (Some(first), Some(last)) = (places.first(), places.last()) else { continue };
        let range = value(*last) - value(*first);
        distance[*first] = f64::INFINITY;
        distance[*last] = f64::INFINITY;
        if range > 0.0 {
            for triple in places.windows(3) {
                distance[triple[1]] += (value(triple[2]) - value(triple[0])) / range;
            }
        }
    }
    distance
}

/// Simulated binary crossing, bounded by the cube: children lie about their parents as if bits had been exchanged.
fn cross(a: &mut [f64], b: &mut [f64], stream: &mut Stream) {
    if stream.unit() > CROSSED {
        return;
    }
    for (a, b) in a.iter_mut().zip(b) {
        let (chosen, u, swapped) = (stream.unit() < 0.5, stream.unit(), stream.unit() < 0.5);
        let (low, high) = (a.min(*b), a.max(*b));
        if !chosen || high - low < 1e-14 {
            continue;
        }
        let spread = |room: f64| {
            let beta = 1.0 + 2.0 * room / (high - low);
            let alpha = 2.0 - power(beta, -(CROSSING + 1.0));
            let inner = if u <= 1.0 / alpha { u * alpha } else { 1.0 / (2.0 - u * alpha) };
            power(inner, 1.0 / (CROSSING + 1.0))
        };
        let down = (0.5 * (low + high - spread(low) * (high - low))).clamp(0.0, 1.0);
        let up = (0.5 * (low + high + spread(1.0 - high) * (high - low))).clamp(0.0, 1.0);
        (*a, *b) = if swapped { (up, down) } else { (down, up) };
    }
}

/// Polynomial mutation: each coordinate with probability one by their number.
fn mutate(point: &mut [f64], stream: &mut Stream) {
    let share = 1.0 / point.len() as f64;
    for x in point {
        let (chosen, u) = (stream.unit() < share, stream.unit());
        if !chosen {
            continue;
        }
        let exponent = 1.0 / (MUTATION + 1.0);
        let step = if u < 0.5 {
            power(2.0 * u + (1.0 - 2.0 * u) * power(1.0 - *x, MUTATION + 1.0), exponent) - 1.0
        } else {
            1.0 - power(2.0 * (1.0 - u) + (2.0 * u - 1.0) * power(*x, MUTATION + 1.0), exponent)
        };
        *x = (*x + step).clamp(0.0, 1.0);
    }
}

/// Volume between a front of two or three objectives and a reference point: of all that some member beats and that beats the reference.
pub(super) fn hypervolume(front: &[&[f64]], reference: &[f64]) -> f64 {
    let mut inside: Vec<&[f64]> =
        front.iter().copied().filter(|point| point.iter().zip(reference).all(|(x, r)| x < r)).collect();
    match reference.len() {
        2 => area(&mut inside, [reference[0], reference[1]]),
        3 => {
            inside.sort_by(|a, b| a[2].total_cmp(&b[2]));
            let mut volume = 0.0;
            for n in 0..inside.len() {
                let top = inside.get(n + 1).map_or(reference[2], |next| next[2]);
                volume += (top - inside[n][2]) * area(&mut inside[..=n].to_vec(), [reference[0], reference[1]]);
            }
            volume
        }
        _ => 0.0,
    }
}

/// Area that the first two coordinates of points cover up to a corner.
fn area(points: &mut [&[f64]], [right, top]: [f64; 2]) -> f64 {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut area, mut height) = (0.0, top);
    for point in points {
        if point[1] < height {
            area += (right - point[0]) * (height - point[1]);
            height = point[1];
        }
    }
    area
}

#[cfg(test)]
mod tests {
    use super::super::stream::Purpose;
    use super::*;

    fn search(generations: u64, objectives: fn(&[f64]) -> (Vec<f64>, f64)) -> Nsga {
        let mut nsga = Nsga::new(40);
        for generation in 0..generations {
            let points = nsga.ask(6, &mut Stream::new(7, Purpose::Generation, generation));
            let member = |point: Vec<f64>| {
                let (objectives, violation) = objectives(&point);
                Member { point, objectives, violation, generation: generation as u32 }
            };
            nsga.tell(points.into_iter().map(member).collect());
            assert!(nsga.is_sound(6, nsga.members[0].objectives.len()));
        }
        nsga
    }

    /// ZDT1 (Zitzler, Deb and Thiele 2000): the front is `f2 = 1 − √f1`, whose hypervolume up to (1, 1) is 2/3.
    fn zdt1(x: &[f64]) -> (Vec<f64>, f64) {
        let g = 1.0 + 9.0 * x[1..].iter().sum::<f64>() / (x.len() - 1) as f64;
        (vec![x[0], g * (1.0 - (x[0] / g).sqrt())], 0.0)
    }

    #[test]
    fn the_front_of_zdt1_is_found_and_covered() {
        let nsga = search(150, zdt1);
        let front = nsga.front();
        assert!(front.len() >= 30, "{} members", front.len());
        for member in &front {
            let [f1, f2] = [member.objectives[0], member.objectives[1]];
            assert!((f2 - (1.0 - f1.sqrt())).abs() < 0.02, "({f1}, {f2}) is off the front");
        }
        let points: Vec<_> = front.iter().map(|member| member.objectives.as_slice()).collect();
        let volume = hypervolume(&points, &[1.0, 1.0]);
        assert!((0.63..2.0 / 3.0).contains(&volume), "{volume}");
    }

    /// A limit that cuts the front: what is kept keeps it.
    #[test]
    fn limits_are_kept() {
        let limited = |x: &[f64]| {
            let (objectives, _) = zdt1(x);
            let violation = (0.3 - objectives[0]).max(0.0);
            (objectives, violation)
        };
        let nsga = search(150, limited);
        let front = nsga.front();
        assert!(front.len() > 10 && front.iter().all(|member| member.objectives[0] >= 0.3));
        assert!(front[0].objectives[0] < 0.32, "{:?}", front[0].objectives);
    }

    /// Against the share of a fine grid that some member beats.
    #[test]
    fn hypervolumes_are_the_volumes_that_are_beaten() {
        let points = [[0.2, 0.7, 0.4], [0.5, 0.3, 0.6], [0.8, 0.1, 0.2], [0.3, 0.6, 0.9], [1.5, 0.0, 0.0]];
        let three: Vec<_> = points.iter().map(<[f64; 3]>::as_slice).collect();
        let two: Vec<_> = points.iter().map(|point| &point[..2]).collect();
        let cells = 60;
        let middle = |n: usize| (n as f64 + 0.5) / cells as f64;
        let beaten = |at: &[f64]| points.iter().any(|point| point.iter().zip(at).all(|(x, y)| x <= y));
        let (mut area, mut volume) = (0, 0);
        for i in 0..cells {
            for j in 0..cells {
                area += usize::from(beaten(&[middle(i), middle(j)]));
                volume += (0..cells).filter(|k| beaten(&[middle(i), middle(j), middle(*k)])).count();
            }
        }
        let share = |count: usize, dimension| count as f64 / f64::powi(cells as f64, dimension);
        assert!((hypervolume(&two, &[1.0, 1.0]) - share(area, 2)).abs() < 1e-9);
        assert!((hypervolume(&three, &[1.0; 3]) - share(volume, 3)).abs() < 1e-9);
    }
}
