//! Forces of pairs on their way to the nodes.

use super::super::chunk::Chunk;
use super::super::press::{PairForce, push};
use super::super::{PIECE, hand_over};

#[test]
fn forces_handed_over_in_pieces_are_those_handed_over_at_once() {
    let count = 2 * PIECE as u32 + 101;
    let mut chunks = Vec::new();
    let mut whole = vec![[0.0; 4]; count as usize];
    for c in 0..97_u32 {
        let any = |i: u32| (c * 7919 + i * 104_729) % count;
        let nodes: Vec<u32> = (0..40).map(any).collect();
        let pushes: Vec<PairForce> = (0..nodes.len() - 3)
            .map(|i| PairForce {
                nodes: [nodes[i], nodes[i + 1], nodes[i + 2], nodes[i + 3]],
                weights: [0.2, 0.3, 0.5],
                force_n: [f64::from(c + 1).sin(), f64::from(nodes[i]).cos(), 0.1],
            })
            .collect();
        for PairForce { nodes: [p, a, b, c], weights, force_n } in &pushes {
            push(&mut whole[*p as usize], 1.0, *force_n);
            push(&mut whole[*a as usize], -weights[0], *force_n);
            push(&mut whole[*b as usize], -weights[1], *force_n);
            push(&mut whole[*c as usize], -weights[2], *force_n);
        }
        let span = nodes.iter().min().copied().unwrap()..nodes.iter().max().unwrap() + 1;
        chunks.push(Chunk { nodes, span, pushes, ..Chunk::default() });
    }
    let mut pieces = vec![[0.0; 4]; count as usize];
    hand_over(&chunks.iter().collect::<Vec<_>>(), 0, &mut pieces, PIECE);
    assert_eq!(pieces, whole);
}
