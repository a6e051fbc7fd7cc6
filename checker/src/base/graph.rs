//! Cycles of small graphs.

/// The cycles of a graph, given by the successors of each vertex, each as its vertices from the first one on; `None` where two
/// of them meet.
pub fn disjoint_cycles(next: &[Vec<usize>]) -> Option<Vec<Vec<usize>>> {
    let n = next.len();
    let reached = |k: usize| {
        let (mut row, mut open) = (vec![false; n], next[k].clone());
        while let Some(j) = open.pop() {
            if !std::mem::replace(&mut row[j], true) {
                open.extend(&next[j]);
            }
        }
        row
    };
    let reach: Vec<Vec<bool>> = (0..n).map(reached).collect();
    // The successor of each vertex on its cycle.
    let mut step: Vec<Option<usize>> = Vec::new();
    for (k, successors) in next.iter().enumerate() {
        let mut back = successors.iter().copied().filter(|&j| reach[j][k]);
        step.push(back.next());
        if back.next().is_some() {
            return None;
        }
    }
    let mut cycles = Vec::new();
    for k in 0..n {
        let (mut at, mut cycle) = (k, Vec::new());
        while let Some(next) = step[at].take() {
            cycle.push(at);
            at = next;
        }
        if !cycle.is_empty() {
            cycles.push(cycle);
        }
    }
    Some(cycles)
}

#[cfg(test)]
mod tests {
    use super::disjoint_cycles;

    #[test]
    fn cycles_are_found_where_they_do_not_meet() {
        assert_eq!(disjoint_cycles(&[]), Some(vec![]));
        assert_eq!(disjoint_cycles(&[vec![0], vec![2, 3], vec![1], vec![]]), Some(vec![vec![0], vec![1, 2]]));
        assert_eq!(disjoint_cycles(&[vec![0, 1], vec![0]]), None);
        assert_eq!(disjoint_cycles(&[vec![1], vec![]]), Some(vec![]));
    }
}
