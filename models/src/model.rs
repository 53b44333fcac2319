//! A model: a scenario put together, ready to predict.

mod in_space;

use crate::assemble::{add_effects, assemble, divide, locate};
use crate::assembly::{Assembly, Segment, Sighting};
use crate::error::{Solved, Unsolved};
use crate::robot::{Workspace, equilibrium, place};
use crate::scenario::{ActuatorChoice, Scenario, Span};
use crate::shape::{Stretch, slid};
use crate::site::SiteState;
use crate::space::around;
use crate::term::{Account, LedgerLine, Loads, Pose, Row, RowKind, Term};
use spelling::units::Range;

/// A robot with its list of terms. Made once from a scenario; predicting does not change it.
pub struct Model {
    assembly: Assembly,
    /// Segment, distance from its start \[m\].
    markers: Vec<(usize, f64)>,
    p_max_pa: f64,
}

/// Pose of the end of the centre line in the coordinates of the clamp.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tip {
    /// Coordinate along the axis of the undeformed body \[m\].
    pub x_m: f64,
    /// Towards azimuth 0, where the actuator of a planar robot is \[m\].
    pub y_m: f64,
    /// Towards azimuth 90°; 0 of a planar robot \[m\].
    pub z_m: f64,
    /// Heading, the total bending angle; in space ∫|κ| ds, whatever the directions \[rad\].
    pub angle_rad: f64,
}

/// A predicted state, and the buffers of its computation. Make it with [`Model::prediction`], use it again and again.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// Marker positions as the camera sees them \[m\].
    pub markers: Vec<[f64; 2]>,
    /// Their third coordinate, 0 of a planar robot \[m\].
    pub markers_z_m: Vec<f64>,
    /// Pose of the end of the centre line, before any camera law.
    pub tip: Tip,
    pub(crate) work: Workspace,
}

impl Model {
    /// Builds sites, segments, terms and laws of a scenario and locates its markers.
    pub fn new(scenario: &Scenario) -> Model {
        Model::with_segments(scenario, &scenario.spans(), None)
    }

    /// The same for a robot that is asked a few times: without the starts that [`Model::new`] solves for all pressures, so that it
    /// is made some 20 times faster, and a prediction takes twice as long. Predictions are equal to rounding.
    ///
    /// ```
    /// use models::{Loads, Model, Scenario, shipped};
    /// let scenario = Scenario::parse(shipped("epam").unwrap()).unwrap();
    /// let [often, rarely] = [Model::new, Model::for_few].map(|made| {
    ///     let (model, loads) = (made(&scenario), Loads::uniform(2e3, 20e3));
    ///     let mut at = model.prediction();
    ///     model.predict(&loads, &mut at).unwrap();
    ///     at.tip.y_m
    /// });
    /// assert!((often - rarely).abs() < 1e-13);
    /// ```
    pub fn for_few(scenario: &Scenario) -> Model {
        Model::without_starts(scenario, &scenario.spans(), None)
    }

    /// The same robot with all lengths along the body times a factor: more units, not longer ones.
    pub(crate) fn stretched(scenario: &Scenario, factor: f64) -> Model {
        let mut spans = scenario.spans();
        for span in &mut spans {
            (span.start_m, span.length_m) = (span.start_m * factor, span.length_m * factor);
        }
        Model::with_segments(scenario, &spans, None)
    }

    pub(crate) fn with_segments(scenario: &Scenario, spans: &[Span], segments: Option<Vec<Segment>>) -> Model {
        let mut model = Model::without_starts(scenario, spans, segments);
        for site in &mut model.assembly.sites {
            site.tabulate(scenario.p_body_pa, scenario.p_max_pa);
        }
        model
    }

    pub(crate) fn without_starts(scenario: &Scenario, spans: &[Span], segments: Option<Vec<Segment>>) -> Model {
        let mut assembly = assemble(scenario, spans, scenario.segments);
        add_effects(scenario, &mut assembly);
        assembly.sites.iter_mut().for_each(crate::muscle::complete);
        // Without transverse loads and terms that vary along it every stretch of equal design is one arc.
        if assembly.node_terms.is_empty() && !assembly.varies && scenario.strips().all(|strip| strip.turns == 0.0) {
            assembly.segments = divide(spans, 1);
        }
        if let Some(own) = segments {
            assembly.segments = own;
        }
        if scenario.is_spatial() {
            let mut strips: Vec<ActuatorChoice> = scenario.strips().copied().collect();
            // A stretched helix begins later.
            let factor = assembly.length_m() / scenario.length_m;
            if (factor - 1.0).abs() > SAME_LENGTH {
                strips.iter_mut().for_each(|strip| strip.start_m *= factor);
            }
            assembly.around = around(&strips, scenario.radius_m, spans.len(), &assembly.segments);
        }
        let markers = scenario.markers_m.iter().map(|s| locate(&assembly.segments, *s)).collect();
        Model { assembly, markers, p_max_pa: scenario.p_max_pa }
    }

    /// Allocates the buffers that [`Model::predict`] fills; the tip and markers are 0 until then.
    pub fn prediction(&self) -> Prediction {
        Prediction {
            markers: vec![[0.0; 2]; self.markers.len()],
            markers_z_m: vec![0.0; self.markers.len()],
            tip: Tip::default(),
            work: Workspace::new(&self.assembly),
        }
    }

    /// Equilibrium, shape and markers at given pressures, on the first loading from rest, at once (what came before and
    /// the time in a hold matter only if [`Model::has_history`]; see [`Model::follow`]). Allocates nothing.
    ///
    /// # Errors
    /// [`Unsolved`] with pressures and place when a pressure is negative or not finite, or nothing balances.
    pub fn predict(&self, loads: &Loads, out: &mut Prediction) -> Solved {
        self.settle(loads, out, false)?;
        self.see(out);
        Ok(())
    }

    /// Like [`Model::predict`], without the markers: all that an inverse needs. `warm` starts from what `out` holds.
    pub(crate) fn settle(&self, loads: &Loads, out: &mut Prediction, warm: bool) -> Solved {
        check(loads)?;
        out.work.history.sleep();
        self.solve(loads, out, warm)?;
        self.place_tip(out);
        Ok(())
    }

    pub(crate) fn solve(&self, loads: &Loads, out: &mut Prediction, warm: bool) -> Solved {
        self.supply(loads, &mut out.work);
        equilibrium(&self.assembly, self.body_pa(loads, &out.work), &mut out.work, warm)
    }

    pub(crate) fn show(&self, out: &mut Prediction) {
        self.place_tip(out);
        self.see(out);
    }

    pub(crate) fn see(&self, out: &mut Prediction) {
        match self.is_spatial() {
            true => self.see_in_space(&self.markers, out),
            false => self.sight(&out.work, &mut out.markers),
        }
    }

    fn place_tip(&self, out: &mut Prediction) {
        if self.is_spatial() {
            return self.place_in_space(out);
        }
        place(&self.assembly, &mut out.work);
        let (work, last) = (&out.work, self.assembly.segments.len());
        let (x_m, y_m, angle_rad) = (work.nodes[2 * last], work.nodes[2 * last + 1], work.headings[last]);
        out.tip = Tip { x_m, y_m, z_m: 0.0, angle_rad };
    }

    /// Potential energy of every term at a predicted state \[J\], in the order in which terms were added. In a state of
    /// [`Model::follow`] a term with history has two lines, what it stores and what it has lost since the start; in one of
    /// [`Model::predict`] its line is the sum.
    pub fn ledger(&self, loads: &Loads, at: &Prediction) -> Vec<Row> {
        let (mut lines, body_pa) = (Vec::new(), self.body_pa(loads, &at.work));
        if self.is_spatial() {
            self.ledger_in_space(body_pa, at, &mut lines);
            return lines;
        }
        for (i, p_act_pa) in at.work.p_act_pa.iter().enumerate() {
            self.site_energies(i, [body_pa, *p_act_pa], &at.work, &mut |line, energy| {
                post(&mut lines, line, RowKind::Stored, energy);
            });
        }
        self.lost_energies(&at.work, &mut lines);
        if at.work.is_sheared() {
            post(&mut lines, WALL_SHEAR, RowKind::Stored, self.shear_energy(body_pa, &at.work));
        }
        self.node_energies(&at.work.nodes, body_pa, &mut lines);
        lines
    }

    /// Energies of the loads at node positions, less the straight robot's.
    fn node_energies(&self, nodes: &[f64], body_pa: f64, lines: &mut Vec<Row>) {
        let (pose, rest) = (Pose::new(nodes, body_pa, 0.0), self.rest_nodes());
        for term in &self.assembly.node_terms {
            let mut unused = vec![0.0; rest.len()];
            let energy = term.add(&pose, &mut unused) - term.add(&Pose { q: &rest, ..pose }, &mut unused);
            post(lines, term.line(), RowKind::Stored, energy);
        }
    }

    /// Curvature per segment \[1/m\] and the segment's start and length \[m\].
    pub fn curvatures<'a>(&'a self, at: &'a Prediction) -> impl Iterator<Item = (Segment, f64)> + 'a {
        self.assembly.segments.iter().zip(&at.work.states).map(|(segment, state)| (*segment, state.curvature))
    }

    /// Equilibrium of every segment, base to tip: actuator coordinate, curvature, line tension.
    pub fn states<'a>(&self, at: &'a Prediction) -> &'a [SiteState] {
        &at.work.states
    }

    /// Largest actuator pressure of the search for an inverse \[Pa\], from the scenario.
    pub fn p_max_pa(&self) -> f64 {
        self.p_max_pa
    }

    /// The parts, for tests over every term.
    pub fn assembly(&self) -> &Assembly {
        &self.assembly
    }

    #[inline]
    pub(crate) fn body_pa(&self, loads: &Loads, work: &Workspace) -> f64 {
        if self.assembly.body.is_empty() {
            return loads.body_pa;
        }
        let most = self.channels().fold(0.0, |most: f64, channel| most.max(loads.actuator_pa[channel]));
        self.assembly.body.iter().fold(loads.body_pa, |p, law| law(p, most, &work.history.moment).max(0.0))
    }

    pub(crate) fn marker_count(&self) -> usize {
        self.markers.len()
    }

    pub(crate) fn supply(&self, loads: &Loads, work: &mut Workspace) {
        if self.is_spatial() {
            return self.supply_strips(&loads.actuator_pa, work);
        }
        let mut at = work.history.moment;
        for (p, segment) in work.p_act_pa.iter_mut().zip(&self.assembly.segments) {
            at.s_m = segment.middle_m();
            *p = self.assembly.supplied(&self.assembly.sites[segment.site], &loads.actuator_pa, &at);
        }
    }

    #[inline]
    pub(crate) fn stretch(&self, work: &Workspace, segment: usize) -> Stretch {
        let centre = self.assembly.site(segment).centre_line;
        let from = [work.nodes[2 * segment], work.nodes[2 * segment + 1]];
        let direction = slid(work.directions[segment], work.shear(segment));
        Stretch::new(from, direction, work.headings[segment], work.states[segment].curvature, centre)
    }

    pub(crate) fn sight(&self, work: &Workspace, markers: &mut [[f64; 2]]) {
        let Some(&(mut current, _)) = self.markers.first() else { return };
        let mut stretch = self.stretch(work, current);
        let largest = || work.p_act_pa.iter().fold(0.0, |most, p| p.max(most));
        let p_act_pa = if self.assembly.camera.is_empty() { 0.0 } else { largest() };
        for (marker, (segment, offset)) in markers.iter_mut().zip(&self.markers) {
            if *segment != current {
                current = *segment;
                stretch = self.stretch(work, current);
            }
            let (xy, heading) = stretch.at(*offset);
            let mut seen = Sighting { xy, heading, p_act_pa, t_s: work.history.moment.t_s };
            for law in &self.assembly.camera {
                law(&mut seen);
            }
            *marker = seen.xy;
        }
    }

    /// Energies of a segment in its state, at the pressures of body and actuator.
    pub(crate) fn site_energies(
        &self,
        index: usize,
        [p_body_pa, p_act_pa]: [f64; 2],
        work: &Workspace,
        post: &mut dyn FnMut(LedgerLine, f64),
    ) {
        let (site, segment) = (self.assembly.site(index), &self.assembly.segments[index]);
        let (state, h) = (&work.states[index], segment.length_m);
        let mut post = |line, energy: f64| post(line, energy * h);
        let at = Pose { s_m: segment.middle_m(), ..Pose::new(&[], p_body_pa, p_act_pa) };
        // Empty pouches have roofs, an empty muscle has no energy.
        if let Some(actuator) = site.actuator.filter(|actuator| p_act_pa > 0.0 || actuator.has_pouches()) {
            let stroke = (actuator.stroke)(&site.shape, state.coordinate);
            site.actuator_energies(&stroke, [state.coordinate, state.tension], &at, &mut post);
        }
        let q = [state.curvature];
        let (mut pose, mut unused) = (Pose { q: &q, ..at }, [0.0]);
        let mut rest = work.history.of_segment(index);
        for term in [&*site.body_pressure, &site.bending as &dyn Term] {
            post(term.line(), term.add(&pose, &mut unused));
        }
        for term in &site.body_terms {
            // At the memory of this very state and without time: the stored energy.
            (pose.memory, rest) = rest.split_at(term.memory().values.min(rest.len()));
            post(term.line(), term.add(&pose, &mut unused));
        }
    }

    fn lost_energies(&self, work: &Workspace, lines: &mut Vec<Row>) {
        let places = self.assembly.segments.iter().map(|segment| &self.assembly.sites[segment.site]);
        let terms = places.flat_map(|site| &site.body_terms).filter(|term| term.memory().values > 0);
        for (term, lost) in terms.zip(work.history.lost()).filter(|_| work.history.awake) {
            post(lines, term.line(), RowKind::Dissipated, lost);
        }
    }

    /// ½ K γ² over the length \[J\].
    pub(crate) fn shear_energy(&self, p_body_pa: f64, work: &Workspace) -> f64 {
        let of = |(i, segment): (usize, &Segment)| {
            let shear = work.shear(i);
            let stiffness = self.assembly.sites[segment.site].shear_stiffness_n(p_body_pa);
            if shear == 0.0 { 0.0 } else { 0.5 * stiffness * shear * shear * segment.length_m }
        };
        self.assembly.segments.iter().enumerate().map(of).sum()
    }

    fn rest_nodes(&self) -> Vec<f64> {
        let axes = self.assembly.axes;
        let mut nodes = vec![0.0; axes * (self.assembly.segments.len() + 1)];
        for (i, segment) in self.assembly.segments.iter().enumerate() {
            nodes[axes * (i + 1)] = nodes[axes * i] + segment.length_m;
        }
        nodes
    }
}

/// Relative difference of lengths that is rounding.
const SAME_LENGTH: f64 = 1e-9;

/// The solver's own bounds of a body pressure: the limit without pressure has closed forms.
const ANY_BODY_PRESSURE: Range = Range { low: 0.0, high: 1000.0, ..Range::BODY_PRESSURE };

/// Largest actuator pressure \[Pa\]: differences about a state stay within it.
pub(crate) const MOST_ACTUATOR_PA: f64 = Range::ACTUATOR_PRESSURE.high * Range::ACTUATOR_PRESSURE.si;

#[inline]
fn bounded(loads: &Loads, body: &Range) -> Solved {
    let pressures = loads.actuator_pa.iter().map(|p| (*p, &Range::ACTUATOR_PRESSURE));
    match std::iter::once((loads.body_pa, body)).chain(pressures).find(|(p, bounds)| !bounds.contains(*p)) {
        Some((value_pa, bounds)) => Err(Unsolved::BadPressure { bounds: *bounds, value_pa }),
        None => Ok(()),
    }
}

impl Loads {
    /// The same pressures, if a robot can have them: what every file, option, stream and call passes.
    ///
    /// # Errors
    /// A pressure out of its bounds.
    pub fn checked(self) -> Solved<Loads> {
        bounded(&self, &Range::BODY_PRESSURE).map(|()| self)
    }
}

#[inline]
pub(crate) fn check(loads: &Loads) -> Solved {
    bounded(loads, &ANY_BODY_PRESSURE)
}

/// Ledger line of the shear, which has no term: its energy follows from the equilibrium.
const WALL_SHEAR: LedgerLine = LedgerLine::new("wall_shear", Account::Wall);

/// Adds to the row of that name and kind, or opens it.
pub(crate) fn post(rows: &mut Vec<Row>, line: LedgerLine, kind: RowKind, energy_j: f64) {
    match rows.iter_mut().find(|row| row.name == line.name && row.kind == kind) {
        Some(row) => row.energy_j += energy_j,
        None => rows.push(line.row(kind, energy_j)),
    }
}
