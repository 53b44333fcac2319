"""Keys of the results: a dictionary with its keys for every record of docs/json.md. Made by python/records.py."""

import typing as t

import typing_extensions as x

class Actuator(x.TypedDict):
    formula: str
    name: str
    reference: str
    sentence: str
    title: str
    validity: str

class Added(x.TypedDict):
    effect: str
    group: str
    parameters: t.List[ParameterValue]

class AddedEffect(x.TypedDict):
    effect: str
    how_known: str
    parameters: t.Optional[t.List[ParameterValue]]
    values: t.Dict[str, float]

class AddedOnData(x.TypedDict):
    after: HowFar
    before: HowFar
    effects: t.List[str]
    fitted_to_these: bool

class AsClose(x.TypedDict):
    effects: t.List[str]
    systematic_after_mm: float

class BaseFit(x.TypedDict):
    bending: t.List[Bending]
    bending_nominal_nm2: float
    bending_with_added_nm2: t.List[float]
    heldout_mm: t.Optional[float]
    heldout_run_mm: t.Optional[float]
    heldout_run_with_added_mm: t.Optional[float]
    heldout_with_added_mm: t.Optional[float]
    left_share: float
    noise_floor_mm: t.Optional[float]
    systematic_mm: float
    systematic_nominal_mm: float
    systematic_with_added_mm: float

class Bending(x.TypedDict):
    at_bound: bool
    hi: t.Optional[float]
    lo: t.Optional[float]
    p_body_kpa: float
    value_nm2: float

class BendingAlarm(x.TypedDict):
    answer_nm2: float
    base_nm2: float
    test_sd_nm2: t.Optional[float]
    told_nm2: float
    words: str

class BestEffect(x.TypedDict):
    effects: t.List[str]
    left_mm: float

class Beyond(x.TypedDict):
    length_mm: float
    limit: str
    s_mm: float
    share: float

class ChamberEnd(x.TypedDict):
    name: str
    pressure_kpa: float
    volume_cm3: float

class Checked(x.TypedDict):
    misses: t.List[Miss]
    warnings: t.List[str]

class CheckedDesign(x.TypedDict):
    chosen: t.List[ChosenValue]
    corrected_by_finite_elements: t.Optional[t.List[Miss]]
    finite_elements: t.Optional[Checked]
    misses: t.List[Miss]
    unchecked: t.Optional[str]
    worst_mm: float
    written: bool

class ChosenValue(x.TypedDict):
    key: str
    value: str

class ClimbStep(x.TypedDict):
    added: t.List[FittedEffect]
    confidence: t.Optional[str]
    file: str
    indistinguishable: t.List[str]
    p_value: t.Optional[float]

class Combination(x.TypedDict):
    bending_nm2: t.List[float]
    bic_difference: float
    cancels: bool
    effects: t.List[str]
    gain: float
    in_set: bool
    p_corrected: t.Optional[float]
    parameters: t.List[ParameterValue]
    systematic_after_mm: float

class Cost(x.TypedDict):
    cpu_s: float
    cpu_s_of_all_sessions: float
    element_steps_per_cpu_s: float
    resumed_at_step: float
    threads: float
    wall_s: float

class Deviation(x.TypedDict):
    in_noise: t.Optional[float]
    mm: float
    p_corrected: t.Optional[float]

class Direct(x.TypedDict):
    frame: bool
    pressure: bool

class Drift(x.TypedDict):
    deviation: Deviation
    hold: float

class Effect(x.TypedDict):
    differs: str
    formula: str
    group: str
    history: bool
    name: str
    parameters: t.List[Parameter]
    reference: str
    remedy: str
    sentence: str
    stage: str
    validity: str

class EnergyLine(x.TypedDict):
    energy_j: float
    kind: str
    name: str

class ErrorStep(x.TypedDict):
    bending_nm2: float
    heldout_pressure_mm: t.Optional[float]
    heldout_run_mm: t.Optional[float]
    how_known: str
    model: str
    training_mm: float

Experiment = x.TypedDict("Experiment", {"direct": Direct, "lambda": float, "name": str, "needed": float, "protocol": str, "runs_needed": t.Optional[float], "sentence": str, "separated": float, "separations": t.List[Separation], "tests": t.List[str]})

class FabricQuantity(x.TypedDict):
    how_known: str
    interval: t.Optional[t.List[float]]
    key: str
    mean: float
    name: str
    sd: t.Optional[float]
    specimens: float
    unit: str

class FeMoment(x.TypedDict):
    actuator_kpa: float
    bend_deg: float
    bend_sd_deg: float
    moment_nm: float
    moment_sd_nm: float

class FileHash(x.TypedDict):
    name: str
    sha256: str

class FirstThrough(x.TypedDict):
    node: float
    part: str
    place_mm: t.List[float]
    text: str
    time_s: float

class FittedBeside(x.TypedDict):
    dataset: str
    direct: Direct
    runs: float
    systematic_mm: float
    systematic_with_added_mm: float

class FittedEffect(x.TypedDict):
    effect: str
    parameters: t.List[ParameterValue]

class ForeignBase(x.TypedDict):
    from_data_mm: float
    from_scenario_mm: float
    sha256: str
    table: str

class GasVolumes(x.TypedDict):
    gas_cm3: t.List[float]
    slope_cm3_per_kpa: t.List[t.List[float]]

class GaugeFit(x.TypedDict):
    after_kpa: float
    before_kpa: float
    dataset: str
    held_s: t.List[float]
    read_kpa: t.List[float]
    set_kpa: t.List[float]
    with_added_kpa: t.List[float]

class Height(x.TypedDict):
    actuator_kpa: float
    base_mm: float
    best_mm: float
    fe_mm: float
    fe_sd_mm: t.Optional[float]
    measured_mm: float
    meets: bool

class Held(x.TypedDict):
    end: float
    gain_mm: float
    key: str

class HoldLabel(x.TypedDict):
    occurrence: float
    p_act_channels_kpa: x.NotRequired[t.List[float]]
    p_act_kpa: float
    p_body_kpa: float
    phase: str

class HoldMetrics(x.TypedDict):
    accuracy_far_markers: t.Optional[float]
    accuracy_interval: t.Optional[t.List[float]]
    markers_left_out: float
    noise_ceiling: t.Optional[float]
    noise_floor_mm: t.Optional[float]
    nrmse_pct: t.Optional[float]
    occurrence: float
    p_act_channels_kpa: x.NotRequired[t.List[float]]
    p_act_kpa: float
    p_body_kpa: float
    p_value: t.Optional[float]
    paper_accuracy: t.Optional[float]
    phase: str
    reduced_chi2: t.Optional[float]
    rms_relative_pct: t.Optional[float]
    rmse_mm: float
    systematic_mm: t.Optional[float]
    tip_distance_mm: float
    tip_error_mm: float
    tip_error_x_mm: float
    tip_error_z_mm: x.NotRequired[float]

class HowFar(x.TypedDict):
    beyond_noise_mm: float
    largest_tip_error_mm: float
    reduced_chi2: t.Optional[float]

class InflatedPouch(x.TypedDict):
    arm_m: float
    height_m: float
    width_m: float

class KeptBending(x.TypedDict):
    indistinguishable: t.List[str]
    systematic_after_mm: float
    value_nm2: float

class KineticShares(x.TypedDict):
    below_10_pct_of_internal: Rule
    below_1_pct_of_total: Rule
    end: t.Optional[float]
    median: t.Optional[float]
    outputs: float
    peak: t.Optional[float]
    peak_time_s: t.Optional[float]

class LackOfFit(x.TypedDict):
    all: float
    drift: float
    hold_means: float
    marker_means: float
    p_value: float
    supply: x.NotRequired[float]

class LearnedLaw(x.TypedDict):
    after_mm: float
    before_mm: float
    bending_nm2: t.List[float]
    check: str
    formula: str
    heldout_after_mm: t.Optional[float]
    heldout_before_mm: t.Optional[float]
    heldout_run_after_mm: t.Optional[float]
    line: t.Optional[LearnedLine]
    name: str
    parameters: t.List[ParameterValue]
    tried: t.List[LearnedTried]
    usual: str
    words: str

class LearnedLine(x.TypedDict):
    heldout_mm: t.Optional[float]
    interval_mm: t.Optional[t.List[float]]
    training_mm: float
    value_mm: float

class LearnedTried(x.TypedDict):
    heldout_mm: float
    missed: float
    numbers: float
    words: str

class LeftPattern(x.TypedDict):
    check: str
    either: bool
    instead: bool
    p_value: float
    share: float
    simpler: bool
    words: str

class LoopGap(x.TypedDict):
    deviation: Deviation
    load_hold: float
    unload_hold: float

class MeasuredShape(x.TypedDict):
    dataset: str
    floor_mm: float
    places_mm: t.List[t.List[float]]
    shared: t.List[SharedNumber]

class MeshQuality(x.TypedDict):
    aspect: float
    jacobian_ratio: float
    side_mm: t.List[float]
    warpage: float

class Miss(x.TypedDict):
    found: t.List[float]
    miss_mm: float
    wanted: t.List[float]
    what: str

class MissingMoment(x.TypedDict):
    bending_nm2: float
    curves: t.List[MomentCurve]
    points: t.List[MomentPoint]
    sentences: t.List[str]
    shapes: t.List[MeasuredShape]

class ModelOnData(x.TypedDict):
    bending_nm2: float
    effects: t.List[str]
    holds: t.List[HoldMetrics]
    how_known: str
    label: str
    overall: OverallMetrics
    residual_map: ResidualMap
    where_it_fails: t.List[Statement]
    why: str

class MomentCurve(x.TypedDict):
    answer: str
    is_told: bool
    is_unloading: bool
    p_body_kpa: float
    points: t.List[t.List[float]]

class MomentPoint(x.TypedDict):
    bend_deg: float
    bend_sd_deg: float
    correlation: float
    dataset: str
    hold: float
    is_change: bool
    moment_nm: float
    moment_sd_nm: float
    p_act_kpa: float
    p_body_kpa: float
    phase: str
    place_mm: t.Optional[t.List[float]]
    t_s: float

class NamedText(x.TypedDict):
    name: str
    title: str

class NextExperiment(x.TypedDict):
    best: str
    needed_now: float
    now: t.List[Separation]
    recommended: t.Optional[Experiment]
    sentence: str
    tried: t.List[Experiment]

class NoiseSummary(x.TypedDict):
    alignment_mm: t.Optional[float]
    camera_mm: t.Optional[float]
    hold_alignment_mm: t.Optional[float]
    hold_bend_pct: t.Optional[float]
    hold_pressure_pct: t.Optional[float]
    hold_rotation_mrad: t.Optional[float]
    lasting_mm: t.Optional[float]
    marker_mm: t.Optional[float]
    noise_of_mean_mm: t.Optional[float]
    p_values: bool
    pressure_pct: t.Optional[float]
    rotation_mrad: t.Optional[float]
    runs: float
    sentence: str
    sessions: float
    status: str
    warning: t.Optional[str]

class OtherDesign(x.TypedDict):
    indistinguishable: t.List[str]
    switched: t.List[str]
    systematic_after_mm: float
    systematic_mm: float
    verdict: t.Optional[str]

class Outlier(x.TypedDict):
    dx_mm: float
    dy_mm: float
    dz_mm: x.NotRequired[float]
    hold: float
    marker: str
    robust_z: float
    run: str
    sample: float

class Outliers(x.TypedDict):
    copies: t.List[t.List[str]]
    runs: t.List[OutlyingRun]
    samples: t.List[Outlier]
    share: float

class OutlyingRun(x.TypedDict):
    p_corrected: float
    run: str
    scatter_ratio: float

class OverallMetrics(x.TypedDict):
    accuracy_interval: t.Optional[t.List[float]]
    d_max_mm: float
    dof: float
    holds_in_accuracy: float
    largest_tip_error_mm: float
    noise_ceiling: t.Optional[float]
    noise_floor_mm: t.Optional[float]
    nrmse_pct: t.Optional[float]
    p_value: t.Optional[float]
    paper_accuracy: t.Optional[float]
    reduced_chi2: t.Optional[float]
    rms_relative_pct: t.Optional[float]
    rmse_mm: float
    systematic_mm: t.Optional[float]

class Parameter(x.TypedDict):
    key: str
    lower: float
    meaning: str
    neutral: float
    starts: t.List[float]
    symbol: str
    typical: float
    unit: str
    upper: float

class ParameterValue(x.TypedDict):
    at_bound: bool
    held: bool
    hi: t.Optional[float]
    key: str
    lo: t.Optional[float]
    symbol: str
    unit: str
    value: float

class PatternMark(x.TypedDict):
    kind: str
    x_mm: t.List[float]
    y_mm: t.List[float]

class PatternPiece(x.TypedDict):
    copies: float
    fabric: str
    marks: t.List[PatternMark]
    name: str
    warp_deg: float
    x_mm: t.List[float]
    y_mm: t.List[float]

class PredictedMarker(x.TypedDict):
    s_mm: float
    x_mm: float
    y_mm: float
    z_mm: x.NotRequired[float]

class PredictedState(x.TypedDict):
    beyond: t.List[Beyond]
    curvature_per_m: t.List[float]
    jacobian: t.List[TipSlope]
    ledger: t.List[Row]
    markers: t.List[PredictedMarker]
    p_act_channels_kpa: t.List[float]
    p_act_kpa: float
    p_body_kpa: float
    sections: x.NotRequired[t.List[SpaceSection]]
    segments: t.List[Segment]
    tip: PredictedTip
    tip_stiffness: t.Optional[TipStiffness]
    volumes: t.Optional[GasVolumes]

class PredictedTip(x.TypedDict):
    angle_deg: float
    x_mm: float
    y_mm: float
    z_mm: x.NotRequired[float]

class PressureSlipFound(x.TypedDict):
    after_mm: t.Optional[float]
    before_mm: t.Optional[float]
    best_effect: t.Optional[BestEffect]
    dataset: str
    words: str

class ProbeEnd(x.TypedDict):
    displacement_mm: t.List[float]
    set: str

class Ranked(x.TypedDict):
    at_bound: bool
    bending_nm2: t.List[float]
    bic_difference: float
    cosine_with_best: float
    differs: str
    effect: str
    gain: float
    group: str
    heldout_mm: t.Optional[float]
    heldout_run_mm: t.Optional[float]
    hi: t.Optional[float]
    in_set: bool
    lo: t.Optional[float]
    notes: t.List[str]
    p_corrected: t.Optional[float]
    parameters: t.List[ParameterValue]
    remedy: str
    sentence: str
    several_minima: bool
    systematic_after_mm: float
    systematic_before_mm: float
    unit: str
    value: float

class ReactionEnd(x.TypedDict):
    force_n: t.List[t.Optional[float]]
    moment_nm: t.List[float]
    set: str

class Reading(x.TypedDict):
    actuator_m3: float
    actuator_pa: float
    ahead_m: t.Optional[float]
    base_n: t.List[float]
    base_nm: t.List[float]
    body_m3: float
    body_pa: float
    inflated: t.Optional[InflatedPouch]
    is_at_rest: bool
    kinetic_share: float
    ledger: t.List[t.List[t.Any]]
    moved_m: t.List[t.List[float]]
    ring_moved_m: t.List[t.List[float]]
    seam: str
    seam_at_m: float
    seam_n_per_m: float
    seam_part: str
    seam_share: t.Optional[float]
    seen_moved_m: t.List[t.List[float]]
    stations_m: t.List[float]
    strips_pa: t.List[float]
    time_s: float
    tip_angle_rad: float
    von_mises_at_m: float
    von_mises_on_seam: bool
    von_mises_pa: float
    von_mises_part: str
    waited_s: float

class Replay(x.TypedDict):
    at_end: float
    direction_deg: float
    law: str
    rms: float
    specimen: str
    used_for_the_law: bool

class ResidualCell(x.TypedDict):
    norm_in_noise: t.Optional[float]
    norm_mm: float
    seen: bool
    x: Deviation
    y: Deviation
    z: x.NotRequired[Deviation]

class ResidualMap(x.TypedDict):
    cells: t.List[t.List[ResidualCell]]
    contrasts: float
    drifts: t.List[Drift]
    holds: t.List[HoldLabel]
    loops: t.List[LoopGap]
    markers: t.List[str]
    tip: float

class RobotSummary(x.TypedDict):
    actuator: str
    base: str
    body_pa: float
    count: float
    is_spatial: bool
    length_m: float
    model: str
    pouch_m: float
    radius_m: float
    readings: t.List[Reading]
    set: t.List[str]
    settings: t.Dict[str, t.Optional[float]]
    snaps: t.List[Snap]
    width_m: float

class Row(x.TypedDict):
    energy_mj: float
    kind: str
    term: str

class Rule(x.TypedDict):
    kept_at: float
    last_broken_s: t.Optional[float]

class ScalingCheck(x.TypedDict):
    pairs: t.List[ScalingPair]
    sentence: str
    verdict: str

class ScalingPair(x.TypedDict):
    high_hold: float
    largest_mm: float
    low_hold: float
    p_body_kpa: t.List[float]
    p_corrected: t.Optional[float]
    ratio: float
    reduced_chi2: t.Optional[float]
    rms_mm: float
    tip_mm: float

class Segment(x.TypedDict):
    length_mm: float
    s_mm: float

Separation = x.TypedDict("Separation", {"lambda": float, "rival": str})

class SetInfo(x.TypedDict):
    files: t.List[str]
    licence: str
    name: str
    provenance: str
    source: str
    title: str

class SharedNumber(x.TypedDict):
    name: str
    sd: float
    unit: str
    value: float

class Snap(x.TypedDict):
    kinetic_j: float
    place_m: float
    released_j: float
    time_s: float

class SpaceSection(x.TypedDict):
    contraction: float
    curvature_yz_per_m: t.List[float]
    length_mm: float
    s_mm: float
    tension_n: t.List[float]

class SpecimenRead(x.TypedDict):
    c10_pa: t.Optional[float]
    direction_deg: float
    file: str
    locking_rad: t.Optional[float]
    modulus_pa: t.Optional[float]
    modulus_to_strain: float
    poisson: t.Optional[float]
    shear_rad_n_per_m: t.Optional[t.List[t.List[float]]]
    slack_strain: float
    specimen: str

class Spread(x.TypedDict):
    tip_x_mm: t.List[float]
    tip_y_mm: t.List[float]
    worst_mm: float

class Statement(x.TypedDict):
    finding: str
    holds: t.List[float]
    largest: t.Optional[Deviation]
    markers: t.List[float]
    sentence: str

class Through(x.TypedDict):
    first: t.Optional[FirstThrough]
    nodes: float
    share: float

class TipSlope(x.TypedDict):
    angle_deg_per_kpa: float
    x_mm_per_kpa: float
    y_mm_per_kpa: float

class TipStiffness(x.TypedDict):
    compliance_mm_per_n: t.List[t.List[float]]
    y_n_per_mm: float

class TwoStiffnesses(x.TypedDict):
    after: float
    before: float

class Undetectable(x.TypedDict):
    effect: str
    group: str
    smallest_detectable: t.Optional[float]
    times_typical: t.Optional[float]
    unit: str

class Validation(x.TypedDict):
    after: HowFar
    before: HowFar
    data: str
    fitted_to_these: bool
    geometry_of_data: t.List[str]
    noise_floor_mm: t.Optional[float]
    p_act_kpa: t.List[float]
    p_body_kpa: t.List[float]
    runs: float
    sentence: str
    verdict: str

class Witness(x.TypedDict):
    actuator_kpa: float
    fe_mj: t.Optional[t.List[float]]
    heights: t.List[Height]
    known: str
    mesh_mm: float
    models: t.List[WitnessRow]
    moments: t.List[FeMoment]
    runs: float
    sentences: t.List[str]

class WitnessRow(x.TypedDict):
    apart_mj: float
    energies_mj: t.List[float]
    name: str
    named: bool

class Worth(x.TypedDict):
    elsewhere: t.Optional[str]
    elsewhere_mm: t.Optional[float]
    here_mm: float

class AddKeys:
    after: t.Optional[ErrorStep]
    'Errors with the effect on the same data'
    also: t.List[FileHash]
    'Further data to which the values were fitted'
    before: t.Optional[ErrorStep]
    'Errors without the effect, with B calibrated'
    bending_nm2: t.Optional[float]
    'B that was written; null if it was kept'
    data: t.Optional[FileHash]
    'Data of the fit; null without'
    date: str
    'Date on which the scenario was written'
    effects: t.List[AddedEffect]
    'Effects that were added, with values and source'
    noise_floor_mm: t.Optional[float]
    'Noise of the mean over runs of the data'
    rungs: t.List[ErrorStep]
    'Errors on the way, as given first'
    scenario_file: str
    'Path or name of the scenario as typed'
    scenario_sha256: str
    'SHA-256 of the scenario that was extended'
    written: str
    'File to which the extended scenario was written'

class CharacterizeKeys:
    fabric_toml: t.Optional[str]
    'Text of a fabric table for finite element cases'
    fill_strain_pa: t.Optional[t.List[t.List[float]]]
    'Curve along the fill: strain, stress'
    measured_toml: t.Optional[str]
    'Lines that record the measured numbers in about.toml'
    notes: t.List[str]
    'Remarks on what was assumed and left out'
    provenance: str
    'How the tests came to be: `measured`, `digitised`, `synthetic`, `published`'
    quantities: t.List[FabricQuantity]
    'Means of the measured quantities over all specimens'
    replays: t.List[Replay]
    'Tests of the specimens recomputed with the fitted law'
    shear_rad_n_per_m: t.Optional[t.List[t.List[float]]]
    'Shear curve: shear angle, shear force per length'
    shear_rad_pa: t.Optional[t.List[t.List[float]]]
    'Shear curve: shear angle, shear stress'
    specimens: t.List[SpecimenRead]
    'Numbers that were read from each specimen'
    thickness_m: t.Optional[float]
    'Thickness of the fabric in the tests'
    warp_strain_pa: t.Optional[t.List[t.List[float]]]
    'Curve along the warp: strain, stress'

class CompareKeys:
    actuator: str
    'Kind of the actuator, `epam` for example'
    added: t.Optional[AddedOnData]
    'What effects that `ibr add` wrote bring here; null without any'
    data: str
    'Path or name of the data as typed'
    holds: t.List[HoldMetrics]
    'Accuracy and its companions, hold by hold'
    models: t.List[ModelOnData]
    'The scenario, then every addition and calibration'
    noise: NoiseSummary
    'Noise of the mean over runs'
    overall: OverallMetrics
    'Accuracy and its companions over all holds'
    pairing: str
    'How prediction and measurement are paired'
    provenance: t.Optional[str]
    'How the data came to be; null without about.toml: `measured`, `digitised`, `synthetic`, `published`'
    residual_map: ResidualMap
    'Residuals of every marker in every hold'
    runs: float
    'Number of runs in the data'
    scaling: ScalingCheck
    'Whether shapes depend on P/p only'
    scenario: str
    'Scenario as typed, or `its own`'
    where_it_fails: t.List[Statement]
    'Where it fails, in plain language'

class DesignKeys:
    chosen: t.List[ChosenValue]
    'Values that were chosen for the free keys'
    designs: t.List[CheckedDesign]
    'With `--correct`: all that were checked, in their order'
    ended: str
    'With `--correct`, reason why no further round ran: `reached`, `spent`, `same`, `unchecked`'
    finite_elements: t.Optional[Checked]
    'Result of one run of the design'
    held: t.List[Held]
    'Ends of ranges that hold the design back, the most first'
    interval: t.Optional[Spread]
    'Over the assumed numbers, where some are named'
    misses: t.List[Miss]
    'The wish by the model as it is, part by part'
    p_act_channels_kpa: t.List[float]
    'Actuator pressure of every channel at the design'
    p_body_kpa: float
    'Body pressure of the best design found'
    reached: bool
    'Every part of the wish is within the tolerance by the model; with `--correct` by finite elements'
    starts: float
    'Number of starts of the search'
    starts_that_agree: float
    'Starts that ended at this design or an equal one'
    tolerance_mm: float
    'Share of the length by which a wish may be missed'
    unchecked: t.Optional[str]
    'Reason why finite elements did not run'
    wish: str
    'Path or name of the wish as typed'

class DiagnoseKeys:
    actuator: str
    'Actuator kind of the scenario, such as `epam`'
    added: t.List[Added]
    'What the verdict `effect` adds, else empty'
    alpha: float
    'Level at which it is judged'
    attempt: t.List[Added]
    'With the verdict `out_of_catalog`: the best that the catalogue can do, which is not enough'
    attempt_alike: t.List[AsClose]
    'The attempt, then what comes as close, its error over all data to a fifth: no more a bare name than an answer is. Empty where one fault does as well as the attempt'
    base: BaseFit
    'The scenario with only its bending stiffness fitted'
    bending_alarm: t.Optional[BendingAlarm]
    'The stiffness of the answer differs from the given one'
    beside: t.List[FittedBeside]
    'Further data in the same fit; errors elsewhere refer to the first data'
    by_design: t.List[AsClose]
    'What follows from how such a robot is cut and joined, and takes a fifth of the error with nothing fitted: to be looked at first'
    confidence: t.Optional[str]
    'How sure the name is; null without verdict `effect`: `hint`, `likely_one_of`, `identified_in_catalog`'
    covered: t.Optional[float]
    'Share of such sets that held a true effect on `ibr bench discovery`; null in space, and where no effect is added'
    data_sha256: t.List[str]
    'SHA-256 of every table as read'
    dataset: str
    'Name of the first dataset that was fitted'
    excluded: t.List[str]
    'What was said not to be here'
    finite_elements: t.Optional[Witness]
    'The same robot in finite elements; null without runs'
    foreign_bases: t.List[ForeignBase]
    "Predictions of another simulator that take the place of the scenario's, of every dataset that has them"
    gauges: t.List[GaugeFit]
    'Gauges at the actuator that were read along'
    indistinguishable: t.List[str]
    'Names that these data cannot separate, best first; for two added effects written `a + b`'
    kept_bending: t.Optional[KeptBending]
    "The answer with the scenario's B, where with a fitted one there is none"
    lack_of_fit_after: t.Optional[LackOfFit]
    'Lack of fit of the final model'
    lack_of_fit_before: t.Optional[LackOfFit]
    'Lack of fit of the calibrated base'
    learned: t.Optional[LearnedLaw]
    'The law of the missing moment that predicts pressures left out, where the catalogue has none, or it was asked for'
    leftover: t.List[Statement]
    'Where and when the final model still fails, in plain language'
    limits: t.List[str]
    'What these data cannot show, whatever the model'
    missing_moment: t.Optional[MissingMoment]
    "What the calibrated base's terms miss at the bends that were measured; null unless it was asked for"
    next_experiment: t.Optional[NextExperiment]
    'What would separate the indistinguishable ones; null if there is nothing to separate'
    noise: NoiseSummary
    "Noise of the first dataset's mean, in printed units"
    other_design: t.Optional[OtherDesign]
    'The robot made otherwise, where that leaves a fifth less'
    outliers: Outliers
    'Samples and runs that stand out'
    p_value: t.Optional[float]
    'One p of "nothing is missing", corrected for everything that was tried; never below 1e-6'
    pairs: t.List[Combination]
    'Pairs of effects, best first; empty if a single effect is enough'
    pattern: t.Optional[LeftPattern]
    'With the verdict `out_of_catalog`: what the misfit looks like, if it looks like something simple'
    pressure_slip: t.Optional[PressureSlipFound]
    'A slip of a pressure column that explains the data better than anything else: the verdict is withheld'
    ranked: t.List[Ranked]
    'Effects of actuator, body and loads, and effects of supply and measurement, best first'
    residuals_after: ResidualMap
    'Residuals of the final model, marker × hold'
    residuals_before: ResidualMap
    'Residuals of the calibrated base, marker × hold'
    rule_out_first: t.List[str]
    'Names among them (or in the ranking within reach of them) that belong to supply or measurement: rule out first'
    runs: float
    'Number of runs of the first dataset, without copies'
    scenario: str
    'Name of the scenario that was diagnosed'
    scenario_file: str
    'Path or name of the scenario as typed'
    slips: t.List[str]
    'Cautions that come before the verdict: slips in the data, that no effect of a robot is. They are in `warnings` too'
    summary: t.List[str]
    'The answer and its reasons, one sentence each'
    tolerance_mm: float
    'Differences up to this are good enough'
    undetectable: t.List[Undetectable]
    'Smallest detectable size of every effect that was not found'
    verdict: t.Optional[str]
    'Verdict; null where no p-value can be formed: the ranking is then uncalibrated: `none`, `effect`, `out_of_catalog`'
    worth: t.Optional[Worth]
    'What the answer is worth in millimetres; null without the verdict `effect`'

class LadderKeys:
    also: t.List[str]
    'Data that were fitted along, as typed'
    data: str
    'Data as typed'
    ending: str
    'Why the ladder ended, as a sentence'
    kept_bending: t.Optional[KeptBending]
    'The answer with the B of the last scenario, where with a fitted one there is none'
    noise_floor_mm: t.Optional[float]
    'Noise of the mean over runs, of one coordinate'
    rungs: t.List[ErrorStep]
    'Errors, the scenario as given first'
    scenario_file: str
    'Scenario as typed'
    steps: t.List[ClimbStep]
    'Effects added by each step, in order'
    stopped: str
    'Why the ladder ended, as a word such as `noise` or `no_p_values`'

class PatternKeys:
    allowance_mm: float
    'Width of the fabric beyond welds and ends'
    notes: t.List[str]
    'What the plan leaves to its reader'
    pieces: t.List[PatternPiece]
    'Pieces to cut, with the marks on each'
    scenario: str
    'Path or name of the scenario as typed'
    weld_mm: float
    'Width of the welds between pieces'
    written: t.List[str]
    'Files of drawings that were written'

class SimulateKeys:
    added_mass_share: float
    'Mass added by scaling, over the true mass'
    began_s: float
    'Time at which it went on from another run; 0 for a run from the start'
    chambers: t.List[ChamberEnd]
    'Pressure and volume of every chamber at the end'
    changed_sides: t.Optional[Through]
    'Nodes that came through a layer; without contact null'
    cost: Cost
    'Processor time, real time and speed of the run'
    dt_s: float
    'Length of the last time step'
    elements: float
    'Number of shell elements of the mesh'
    engine: float
    'Number of the engine that made it'
    external_work_j: float
    'Work done from outside since the start'
    hourglass_share: float
    'Energy of hourglass control over all that is stored'
    kinetic_j: float
    'Kinetic energy at the end'
    kinetic_share: KineticShares
    'Kinetic energy over kinetic and stored energy, at the outputs'
    ledger: t.List[EnergyLine]
    'Energies of every term at the end'
    name: str
    'Name of the case or scenario'
    nodes: float
    'Number of nodes of the mesh'
    probes: t.List[ProbeEnd]
    'Node sets that the case asks for'
    quality: t.Optional[MeshQuality]
    'Shape of the elements: sides, and the worst ratios'
    reactions: t.List[ReactionEnd]
    'Force and moment of every support at the end'
    residual_j: float
    'Energy that the balance misses at the end'
    residual_share: float
    'The same over what it is judged against'
    residual_share_peak: float
    'Largest value of that share at any output'
    robot: t.Optional[RobotSummary]
    'What was read of a robot'
    selective_mass: bool
    'Whether waves of a few elements are heavy in place of everything'
    steps: float
    'Number of steps of the whole run'
    time_s: float
    'Simulated time at the end of the run'

class ValidateKeys:
    added: t.List[str]
    'Effects that `ibr add` wrote and the data judge'
    bending_nm2: t.Optional[TwoStiffnesses]
    "Bending stiffness without and with the effects; null for a correction of another simulator's predictions"
    datasets: t.List[Validation]
    'One for each of the data'
    scenario_file: str
    'Path or name of the scenario or of the correction as typed'
