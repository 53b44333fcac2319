//! A dataset as a table with one row per run, sample and marker.

use crate::dataset::Dataset;
use crate::table::{Column, Table};
use crate::units::{kpa, mm};

impl Dataset {
    /// The dataset as a tidy table in mm and kPa, with the columns of the marker CSV (pressures of the holds); `z_mm` and the pressures
    /// of further supply channels are there if they were read, `s_mm` if every marker has a station, `p_gauge_kpa` if a gauge was
    /// read.
    pub fn to_table(&self) -> Table {
        let mut rows =
            Vec::with_capacity(self.runs.len() * self.holds.len() * self.samples_per_hold * self.markers.len());
        for run in 0..self.runs.len() {
            for hold in 0..self.holds.len() {
                for sample in 0..self.samples_per_hold {
                    let seen = (0..self.markers.len()).filter(|marker| !self.is_lost(run, hold, *marker));
                    rows.extend(seen.map(|marker| [run, hold, sample, marker]));
                }
            }
        }
        type Row = [usize; 4];
        let text = |of: &dyn Fn(&Row) -> String| Column::Str(rows.iter().map(of).collect());
        let number = |of: &dyn Fn(&Row) -> f64| Column::F64(rows.iter().map(of).collect());
        let place =
            |axis: usize| number(&|[run, hold, sample, marker]| mm(self.place(*run, *hold, *sample, *marker)[axis]));
        let mut columns = vec![
            ("run".to_string(), text(&|row| self.runs[row[0]].clone())),
            ("actuator".into(), text(&|_| self.actuator.clone())),
            ("phase".into(), text(&|row| self.holds[row[1]].phase.word().into())),
            ("marker".into(), text(&|row| self.markers[row[3]].name.clone())),
            ("t_s".into(), number(&|row| self.holds[row[1]].t_s[row[2]])),
            ("p_body_kpa".into(), number(&|row| kpa(self.holds[row[1]].p_body_pa))),
            ("p_act_kpa".into(), number(&|row| kpa(self.holds[row[1]].p_act_pa))),
        ];
        let more = |channel: usize| number(&|row| kpa(self.holds[row[1]].more_act_pa[channel]));
        columns.extend((0..self.more_channels()).map(|channel| (format!("p_act_{}_kpa", channel + 1), more(channel))));
        let axes = ["x_mm", "y_mm", "z_mm"].into_iter().enumerate().take(self.axes);
        columns.extend(axes.map(|(axis, name)| (name.to_string(), place(axis))));
        if self.markers.iter().all(|marker| marker.station_m.is_some()) {
            let station = number(&|row| mm(self.markers[row[3]].station_m.unwrap_or(f64::NAN)));
            columns.push(("s_mm".into(), station));
        }
        if self.gauge_pa.is_some() {
            let read = |[run, hold, sample, _]: &Row| {
                self.gauge(*run).map_or(f64::NAN, |all| kpa(all[hold * self.samples_per_hold + sample]))
            };
            columns.push(("p_gauge_kpa".into(), number(&read)));
        }
        Table { columns }
    }
}
