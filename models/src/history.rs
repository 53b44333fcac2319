//! What a robot remembers on its way through a protocol.

use crate::assembly::{Assembly, Moment};
use crate::site::SiteState;
use crate::term::{Memory, Pose};

/// Memory of every term with history in every segment. Empty in a model without; made once with the buffers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct History {
    /// Whether states count with what came before; a single prediction starts from rest and ignores it.
    pub awake: bool,
    /// Time since the remembered state \[s\].
    pub dt_s: f64,
    /// Time in the hold and in the protocol.
    pub moment: Moment,
    /// Changes whenever the memory does, so that no solve reuses a balance of another memory.
    pub stamp: u32,
    values: Vec<f64>,
    next: Vec<f64>,
    /// Where each segment's values start, and their end.
    offsets: Vec<usize>,
    /// Energy lost since the start, per segment and term with history \[J\].
    lost_j: Vec<f64>,
}

impl History {
    pub(crate) fn new(assembly: &Assembly) -> History {
        let (mut offsets, mut terms) = (vec![0], 0);
        for segment in &assembly.segments {
            let kept = assembly
                .sites
                .get(segment.site)
                .into_iter()
                .flat_map(|site| site.body_terms.iter().map(|term| term.memory()));
            let kept: Vec<Memory> = kept.filter(|memory| memory.values > 0).collect();
            terms += kept.len();
            offsets.push(offsets[offsets.len() - 1] + kept.iter().map(|memory| memory.values).sum::<usize>());
        }
        let count = offsets[offsets.len() - 1];
        let (values, next, lost_j) = (vec![0.0; count], vec![0.0; count], vec![0.0; terms]);
        History { awake: false, dt_s: 0.0, moment: Moment::default(), stamp: 0, values, next, offsets, lost_j }
    }

    /// At rest at time zero, from here on with memory.
    pub(crate) fn start(&mut self) {
        (self.awake, self.dt_s, self.moment) = (true, 0.0, Moment::default());
        self.values.fill(0.0);
        self.lost_j.fill(0.0);
        self.stamp = self.stamp.wrapping_add(1).max(1);
    }

    pub(crate) fn sleep(&mut self) {
        (self.awake, self.dt_s, self.moment, self.stamp) = (false, 0.0, Moment::default(), 0);
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    pub(crate) fn of_segment(&self, index: usize) -> &[f64] {
        if self.awake { &self.values[self.offsets[index]..self.offsets[index + 1]] } else { &[] }
    }

    /// Takes the equilibrium in `states` as reached.
    pub(crate) fn remember(&mut self, assembly: &Assembly, p_body_pa: f64, states: &[SiteState], p_act_pa: &[f64]) {
        if self.is_empty() {
            return;
        }
        self.next.copy_from_slice(&self.values);
        let (mut from, mut term_index) = (0, 0);
        for (i, segment) in assembly.segments.iter().enumerate() {
            let q = [states[i].curvature];
            for term in &assembly.sites[segment.site].body_terms {
                let count = term.memory().values;
                if count == 0 {
                    continue;
                }
                let memory = &self.values[from..from + count];
                let at =
                    Pose { q: &q, p_body_pa, p_act_pa: p_act_pa[i], s_m: segment.middle_m(), dt_s: self.dt_s, memory };
                self.lost_j[term_index] += term.remember(&at, &mut self.next[from..from + count]) * segment.length_m;
                from += count;
                term_index += 1;
            }
        }
        std::mem::swap(&mut self.values, &mut self.next);
        self.stamp = self.stamp.wrapping_add(1).max(1);
    }

    /// Energy lost since the start by every term with history, segment by segment \[J\].
    pub(crate) fn lost(&self) -> impl Iterator<Item = f64> + '_ {
        self.lost_j.iter().copied()
    }
}
