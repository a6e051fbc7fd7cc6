use super::matrix::Matrix;

/// The strongly connected components of the graph with an edge `i -> j` where entry `(i, j)` is not 0: index sets,
/// each ascending. The characteristic polynomial is the product of those of the diagonal blocks.
///
/// Source: Tarjan 1972, without recursion.
///
/// # Examples
/// ```
/// use secant_exact::{arith::ratio, linalg::{Matrix, strong_components}};
/// let a = Matrix::from_fn(3, 3, |i, j| ratio([[0, 1, 1], [1, 0, 0], [0, 0, 1]][i][j], 1));
/// let mut parts = strong_components(&a);
/// parts.sort();
/// assert_eq!(parts, [vec![0, 1], vec![2]]);
/// ```
pub fn strong_components(a: &Matrix) -> Vec<Vec<usize>> {
    let n = a.rows();
    let edges: Vec<Vec<usize>> = (0..n).map(|i| (0..n).filter(|&j| a[(i, j)] != 0).collect()).collect();
    let mut search =
        Search { order: vec![usize::MAX; n], low: vec![0; n], on_stack: vec![false; n], ..Search::default() };
    for start in 0..n {
        if search.order[start] == usize::MAX {
            search.visit(start, &edges);
        }
    }
    search.found
}

#[derive(Default)]
struct Search {
    order: Vec<usize>,
    low: Vec<usize>,
    on_stack: Vec<bool>,
    stack: Vec<usize>,
    found: Vec<Vec<usize>>,
    count: usize,
}

impl Search {
    fn enter(&mut self, v: usize) {
        self.order[v] = self.count;
        self.low[v] = self.count;
        self.count += 1;
        self.stack.push(v);
        self.on_stack[v] = true;
    }

    fn visit(&mut self, start: usize, edges: &[Vec<usize>]) {
        self.enter(start);
        let mut path = vec![(start, 0)];
        while let Some((v, next)) = path.pop() {
            if let Some(&w) = edges[v].get(next) {
                path.push((v, next + 1));
                if self.order[w] == usize::MAX {
                    self.enter(w);
                    path.push((w, 0));
                } else if self.on_stack[w] {
                    self.low[v] = self.low[v].min(self.order[w]);
                }
                continue;
            }
            if let Some(&(parent, _)) = path.last() {
                self.low[parent] = self.low[parent].min(self.low[v]);
            }
            if self.low[v] == self.order[v] {
                self.close(v);
            }
        }
    }

    fn close(&mut self, v: usize) {
        let mut component = Vec::new();
        while let Some(w) = self.stack.pop() {
            self.on_stack[w] = false;
            component.push(w);
            if w == v {
                break;
            }
        }
        component.sort_unstable();
        self.found.push(component);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn components_of_a_small_graph() {
        // 0 -> 1 -> 2 -> 1, 3 -> 0, 4 alone
        let edges = [(0, 1), (1, 2), (2, 1), (3, 0), (2, 4)];
        let a = Matrix::from_fn(5, 5, |i, j| ratio(i64::from(edges.contains(&(i, j))), 1));
        let mut found = strong_components(&a);
        found.sort();
        assert_eq!(found, vec![vec![0], vec![1, 2], vec![3], vec![4]]);
    }
}
