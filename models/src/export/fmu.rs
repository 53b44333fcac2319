//! The texts of a functional mock-up unit (FMI 3.0, co-simulation) around a table and the supply line.
//!
//! Format: <https://fmi-standard.org/docs/3.0/>. A unit is a ZIP archive of them, with a library compiled from them.

use super::rigid::xml;
use super::{Origin, Table};
use crate::line::Line;

const SOURCE: &str = include_str!("fmu.c");

impl Table {
    /// Files of the unit by their names in the archive; sources are those that begin with `sources/` and end with `.c`.
    pub fn fmu_files(&self, origin: &Origin, line: Option<&Line>) -> Vec<(String, String)> {
        let name = origin.name();
        let own = &Origin { prefix: &name, ..origin.clone() };
        let [header, table] = self.c_files(own);
        let [time_s, flow, ratio] = line.map_or([0.0, 0.0, 0.5], |line| {
            let flow = if line.flow_per_s.is_finite() { line.flow_per_s } else { 0.0 };
            [line.valve_time_s, flow, line.critical_ratio]
        });
        let token = format!("{{ibr-{name}-{}-{}}}", self.pieces(), self.markers());
        let unit = SOURCE
            .replace("@VALVE_TIME@", &format!("{time_s:?}"))
            .replace("@FLOW@", &format!("{flow:?}"))
            .replace("@RATIO@", &format!("{ratio:?}"))
            .replace("@TOKEN@", &token);
        vec![
            ("modelDescription.xml".into(), self.description(own, &name, &token)),
            ("sources/buildDescription.xml".into(), build(&name)),
            (format!("sources/{name}.h"), header),
            (format!("sources/{name}.c"), table),
            ("sources/fmu.c".into(), self.fill(&unit, own)),
        ]
    }

    fn description(&self, origin: &Origin, name: &str, token: &str) -> String {
        let markers = (1..=self.markers()).flat_map(|i| ["x", "y"].map(|axis| (format!("marker_{i}_{axis}_mm"), "mm")));
        let tip = [("p_arrived_kpa", "kPa"), ("tip_x_mm", "mm"), ("tip_y_mm", "mm"), ("angle_deg", "deg")];
        let outputs: Vec<(String, &str)> =
            tip.map(|(name, unit)| (name.to_string(), unit)).into_iter().chain(markers).collect();
        let variable = |(i, (name, unit)): (usize, &(String, &str))| {
            format!("<Float64 name=\"{name}\" valueReference=\"{}\" causality=\"output\" unit=\"{unit}\"/>\n", i + 2)
        };
        let variables: String = outputs.iter().enumerate().map(variable).collect();
        let listed = |element: &str| -> String {
            (0..outputs.len()).map(|i| format!("<{element} valueReference=\"{}\"/>\n", i + 2)).collect()
        };
        format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <fmiModelDescription fmiVersion=\"3.0\" modelName=\"{robot}\" instantiationToken=\"{token}\" \
             description=\"made by ibr: {command}\" generationTool=\"ibr\">\n\
             <CoSimulation modelIdentifier=\"{name}\" canHandleVariableCommunicationStepSize=\"true\"/>\n\
             <UnitDefinitions>\n\
             <Unit name=\"kPa\"><BaseUnit kg=\"1\" m=\"-1\" s=\"-2\" factor=\"1000\"/></Unit>\n\
             <Unit name=\"mm\"><BaseUnit m=\"1\" factor=\"0.001\"/></Unit>\n\
             <Unit name=\"deg\"><BaseUnit rad=\"1\" factor=\"0.017453292519943295\"/></Unit>\n\
             </UnitDefinitions>\n<DefaultExperiment stopTime=\"1\" stepSize=\"0.01\"/>\n<ModelVariables>\n\
             <Float64 name=\"time\" valueReference=\"0\" causality=\"independent\"/>\n\
             <Float64 name=\"p_act_kpa\" valueReference=\"1\" causality=\"input\" unit=\"kPa\" min=\"{low}\" max=\"{high}\" start=\"{low}\"/>\n\
             {variables}</ModelVariables>\n<ModelStructure>\n{outputs}{unknowns}</ModelStructure>\n</fmiModelDescription>\n",
            robot = xml(origin.robot),
            command = xml(origin.command),
            low = self.range_pa[0] / 1e3,
            high = self.range_pa[1] / 1e3,
            outputs = listed("Output"),
            unknowns = listed("InitialUnknown"),
        )
    }
}

fn build(name: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiBuildDescription fmiVersion=\"3.0\">\n\
         <BuildConfiguration modelIdentifier=\"{name}\">\n<SourceFileSet language=\"C99\">\n<SourceFile name=\"{name}.c\"/>\n\
         <SourceFile name=\"fmu.c\"/>\n</SourceFileSet>\n</BuildConfiguration>\n</fmiBuildDescription>\n"
    )
}
