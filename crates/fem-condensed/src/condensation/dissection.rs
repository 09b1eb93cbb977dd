//! The order in which the nodes of a mesh are eliminated: nested dissection (George 1973).
//!
//! A separator divides a set of nodes into two parts without a common element, and is eliminated after both. The
//! parts are divided in the same way, until they have few nodes and are treated as dense.
//!
//! Separators follow from two integer coordinates of a node, counted in elements: its distance from the fixed node
//! (the number of its ring), and its position along the ring (elements to the axis minus elements to the surface).
//! Within an element the first changes by at most 1, the second by at most 2. So the nodes of one ring, or of two
//! successive positions, are a separator in any mesh.

use fem_mesh::SphereMesh;

/// Number of nodes up to which a set is not divided. Dense products are efficient from about this size on.
const UNDIVIDED_NODES: usize = 14;
/// Distance of a node that is not reached yet.
const UNREACHED: u32 = u32::MAX;

/// Nodes in the order of elimination, in sets.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Dissection {
    pub nodes: Vec<u32>,
    /// End of each set in the order of elimination.
    pub ends: Vec<usize>,
}

/// A node with its integer coordinates.
#[derive(Debug, Clone, Copy)]
struct Place {
    node: u32,
    /// Ring, and position in the ring.
    numbers: [i32; 2],
}

impl Dissection {
    /// Orders the nodes of a mesh for which `is_interior` is true.
    pub fn new(mesh: &SphereMesh, is_interior: impl Fn(usize) -> bool) -> Self {
        let neighbours = Neighbours::new(mesh);
        let ground = &mesh.axis()[mesh.axis().len() - 1..];
        let far = if mesh.is_half_space() { mesh.far_boundary() } else { ground };
        let rings = neighbours.distances(mesh, far);
        let from_axis = neighbours.distances(mesh, mesh.axis());
        let from_surface = neighbours.distances(mesh, mesh.surface());
        let mut places: Vec<Place> = (0..mesh.nodes().len())
            .filter(|&node| is_interior(node))
            .map(|node| Place {
                node: node as u32,
                numbers: [rings[node] as i32, from_axis[node] as i32 - from_surface[node] as i32],
            })
            .collect();
        let mut dissection = Self { nodes: Vec::with_capacity(places.len()), ends: Vec::new() };
        let mut scratch = Vec::with_capacity(places.len());
        dissection.part(&mut places, &mut scratch, &mut Vec::new());
        dissection
    }

    /// Adds a set of nodes, divided recursively as long as that reduces the work.
    fn part(&mut self, places: &mut [Place], scratch: &mut Vec<Place>, counts: &mut Vec<u32>) {
        if places.len() > UNDIVIDED_NODES {
            let mut directions = Direction::both(places);
            // The longer extent is divided first.
            directions.sort_by_key(|direction| -direction.extent());
            if let Some(cut) = directions.iter().find_map(|direction| direction.cut(places, counts))
            {
                let [n_below, n_between] = cut.sizes(counts);
                let n_above = places.len() - n_below - n_between;
                let mut next = [0, n_below, n_below + n_above];
                scratch.clear();
                scratch.extend_from_slice(places);
                for place in &*scratch {
                    let next = &mut next[cut.side(place)];
                    places[*next] = *place;
                    *next += 1;
                }
                let (sides, between) = places.split_at_mut(n_below + n_above);
                let (below, above) = sides.split_at_mut(n_below);
                self.part(below, scratch, counts);
                self.part(above, scratch, counts);
                self.end(between);
                return;
            }
        }
        self.end(places);
    }

    fn end(&mut self, piece: &[Place]) {
        self.nodes.extend(piece.iter().map(|place| place.node));
        self.ends.push(self.nodes.len());
    }
}

/// Largest change of the ring and of the position in it within an element.
const WIDTHS_OF_ELEMENT: [i32; 2] = [1, 2];

/// A coordinate by which a set may be divided, with its range.
#[derive(Debug, Clone, Copy)]
struct Direction {
    /// Index of the coordinate in [`Place::numbers`].
    which: usize,
    least: i32,
    greatest: i32,
}

impl Direction {
    fn both(places: &[Place]) -> [Self; 2] {
        let first = places.first().map_or([0; 2], |place| place.numbers);
        let mut both =
            [0, 1].map(|which: usize| Self { which, least: first[which], greatest: first[which] });
        for place in places {
            for (direction, number) in both.iter_mut().zip(place.numbers) {
                direction.least = direction.least.min(number);
                direction.greatest = direction.greatest.max(number);
            }
        }
        both
    }

    fn extent(&self) -> i32 {
        (self.greatest - self.least) / WIDTHS_OF_ELEMENT[self.which]
    }

    /// Returns the separator at the median; `None` if one side would be empty. `counts` becomes the number of nodes
    /// with each value of the coordinate.
    fn cut(&self, places: &[Place], counts: &mut Vec<u32>) -> Option<Cut> {
        counts.clear();
        counts.resize((self.greatest - self.least) as usize + 1, 0);
        let number = |place: &Place| (place.numbers[self.which] - self.least) as usize;
        places.iter().for_each(|place| counts[number(place)] += 1);
        let mut below = 0;
        let median = counts.iter().position(|&count| {
            below += count as usize;
            2 * below > places.len()
        })?;
        let from = self.least + median as i32;
        let cut = Cut {
            which: self.which,
            least: self.least,
            from,
            to: from + WIDTHS_OF_ELEMENT[self.which],
        };
        (self.least < cut.from && cut.to <= self.greatest).then_some(cut)
    }
}

/// A separator: all nodes whose coordinate is at least `from` and less than `to`.
#[derive(Debug, Clone, Copy)]
struct Cut {
    which: usize,
    least: i32,
    from: i32,
    to: i32,
}

impl Cut {
    /// Returns 0 for a node below the separator, 1 above, 2 within.
    fn side(&self, place: &Place) -> usize {
        match place.numbers[self.which] {
            number if number < self.from => 0,
            number if number >= self.to => 1,
            _ => 2,
        }
    }

    /// Returns the number of nodes below and within, from the numbers of nodes with each value.
    fn sizes(&self, counts: &[u32]) -> [usize; 2] {
        let [from, to] = [self.from, self.to].map(|number| (number - self.least) as usize);
        [&counts[..from], &counts[from..to]].map(|counts| counts.iter().sum::<u32>() as usize)
    }
}

/// The elements of each node.
struct Neighbours {
    starts: Vec<usize>,
    elements: Vec<u32>,
}

impl Neighbours {
    fn new(mesh: &SphereMesh) -> Self {
        let mut starts = vec![0; mesh.nodes().len() + 1];
        mesh.quads().iter().flatten().for_each(|&node| starts[node as usize + 1] += 1);
        for node in 1..starts.len() {
            starts[node] += starts[node - 1];
        }
        let mut next = starts.clone();
        let mut elements = vec![0; 4 * mesh.quads().len()];
        for (element, quad) in mesh.quads().iter().enumerate() {
            for &node in quad {
                elements[next[node as usize]] = element as u32;
                next[node as usize] += 1;
            }
        }
        Self { starts, elements }
    }

    /// Returns the number of elements on the shortest path from each node to one of some nodes; 0 if there is none.
    fn distances(&self, mesh: &SphereMesh, from: &[u32]) -> Vec<u32> {
        let mut distances = vec![UNREACHED; mesh.nodes().len()];
        let mut front = from.to_vec();
        front.iter().for_each(|&node| distances[node as usize] = 0);
        let (mut next, mut distance) = (Vec::new(), 0);
        while !front.is_empty() {
            distance += 1;
            for &node in &front {
                let own = self.starts[node as usize]..self.starts[node as usize + 1];
                for &element in &self.elements[own] {
                    for corner in mesh.quads()[element as usize] {
                        if distances[corner as usize] == UNREACHED {
                            distances[corner as usize] = distance;
                            next.push(corner);
                        }
                    }
                }
            }
            std::mem::swap(&mut front, &mut next);
            next.clear();
        }
        for distance in &mut distances {
            *distance = if *distance == UNREACHED { 0 } else { *distance };
        }
        distances
    }
}
