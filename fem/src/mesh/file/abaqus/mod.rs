//! Abaqus input (`.inp`): parts, instances, orphan meshes, sets, surfaces. Its keyword lines and rows, one after the other;
//! [`assemble`] makes a mesh of them.
//!
//! Elements of a section are a part, those without one the set that their `*ELEMENT` names. Other element sets and all node sets
//! are node sets. Surfaces with sides may be chambers.

mod assemble;
mod keywords;
mod model;

use super::build::MeshFile;
use super::scan::{Scan, number, numbers, whole};
use crate::vec3::V3;
use keywords::{IGNORED, Keyword, REFUSED, SHAPES};
use model::{Body, ElementSides, FileContent, FileElement, FileSection, Instance, NamedSet, Orientation, SetMember};

enum OpenBlock {
    Nothing,
    Nodes { grouped: bool },
    Elements { corners: usize, set: Option<String>, row: Vec<u64> },
    Group { generate: bool },
    Surface,
    Place,
    Pressed,
    Orientation,
}

struct InputReader {
    model: FileContent,
    /// The body that lines belong to.
    body: usize,
    reading: OpenBlock,
    /// True inside `*STEP`, of which only pressures are read.
    in_step: bool,
}

pub(super) fn read(scan: &mut Scan) -> Result<MeshFile, String> {
    // The whole text.
    let (bodies, instances) = (vec![Body::default()], vec![Instance::default()]);
    let model = FileContent { bodies, instances, ..FileContent::default() };
    let mut reader = InputReader { model, body: 0, reading: OpenBlock::Nothing, in_step: false };
    while let Some(line) = scan.line() {
        if line.starts_with("**") {
            continue;
        }
        match line.strip_prefix('*') {
            Some(first) => {
                let (mut text, at) = (first.to_string(), scan.number);
                while text.ends_with(',') {
                    text += scan.line().ok_or("the file ends within a keyword line")?;
                }
                reader.keyword(&Keyword::of(&text, at))?;
            }
            None => reader.row(line, scan.number)?,
        }
    }
    assemble::mesh(&reader.model, scan)
}

impl InputReader {
    fn body(&mut self) -> &mut Body {
        &mut self.model.bodies[self.body]
    }

    fn keyword(&mut self, keyword: &Keyword) -> Result<(), String> {
        if let OpenBlock::Elements { row, .. } = &self.reading
            && !row.is_empty()
        {
            return Err(format!("the element above has {} numbers, which are too few", row.len()));
        }
        self.reading = OpenBlock::Nothing;
        let name = keyword.name.as_str();
        match name {
            "STEP" => self.in_step = true,
            "ENDSTEP" => self.in_step = false,
            "DSLOAD" => self.reading = OpenBlock::Pressed,
            _ if self.in_step => {}
            "PART" => {
                self.body = self.model.bodies.len();
                self.model.bodies.push(Body { name: keyword.needed("NAME")?, ..Body::default() });
            }
            "ENDPART" | "ENDINSTANCE" => self.body = 0,
            "ASSEMBLY" | "ENDASSEMBLY" => {}
            "INSTANCE" => self.instance(keyword)?,
            "NODE" => self.nodes(keyword)?,
            "ELEMENT" => self.elements(keyword)?,
            "NSET" | "ELSET" => self.group(keyword)?,
            "SURFACE" => self.surface(keyword)?,
            "SHELLSECTION" | "MEMBRANESECTION" | "SHELLGENERALSECTION" | "SURFACESECTION" => {
                let (set, orientation) = (keyword.needed("ELSET")?, keyword.get("ORIENTATION"));
                self.body().sections.push(FileSection { set, orientation, line: keyword.line });
                self.ignore(keyword);
            }
            "ORIENTATION" => self.orientation(keyword)?,
            _ => {
                if let Some((_, why)) = REFUSED.iter().find(|(known, _)| *known == name) {
                    return Err(format!("*{} is not read: {why}", keyword.written));
                }
                if !IGNORED.split(' ').any(|known| known == name) {
                    return Err(format!(
                        "unknown keyword *{}; remove it if the mesh is whole without it",
                        keyword.written
                    ));
                }
                self.ignore(keyword);
            }
        }
        if name == "STEP" {
            self.ignore(keyword);
        }
        Ok(())
    }

    fn ignore(&mut self, keyword: &Keyword) {
        self.model.ignored.push((format!("*{}", keyword.written), keyword.line));
    }

    fn orientation(&mut self, keyword: &Keyword) -> Result<(), String> {
        let other = |name: &str, usual: &str| keyword.get(name).filter(|value| !value.eq_ignore_ascii_case(usual));
        let other = other("SYSTEM", "RECTANGULAR").or_else(|| other("DEFINITION", "COORDINATES"));
        let (name, line) = (keyword.needed("NAME")?, keyword.line);
        self.body().orientations.push(Orientation { name, rows: Vec::new(), other, line });
        self.reading = OpenBlock::Orientation;
        Ok(())
    }

    fn instance(&mut self, keyword: &Keyword) -> Result<(), String> {
        let (name, part) = (keyword.needed("NAME")?, keyword.needed("PART")?);
        let found = self.model.bodies.iter().position(|body| body.name.eq_ignore_ascii_case(&part));
        let body =
            found.filter(|at| *at > 0).ok_or_else(|| format!("unknown *PART `{part}`; define it above this line"))?;
        self.model.instances.push(Instance { name, body, ..Instance::default() });
        // What an instance adds to its part has the numbers of the part.
        self.body = body;
        self.reading = OpenBlock::Place;
        Ok(())
    }

    fn nodes(&mut self, keyword: &Keyword) -> Result<(), String> {
        keyword.without("INPUT", "put the rows of that file here")?;
        if keyword.get("SYSTEM").is_some_and(|system| !system.eq_ignore_ascii_case("R")) {
            return Err("nodes in cylindrical or spherical coordinates are not read; write x, y, z".into());
        }
        let set = keyword.get("NSET");
        self.reading = OpenBlock::Nodes { grouped: set.is_some() };
        set.into_iter().for_each(|name| self.open_group(name, false, keyword));
        Ok(())
    }

    fn elements(&mut self, keyword: &Keyword) -> Result<(), String> {
        keyword.without("INPUT", "put the rows of that file here")?;
        let kind = keyword.needed("TYPE")?.to_ascii_uppercase();
        let Some((_, corners)) = SHAPES.iter().find(|(known, _)| *known == kind) else {
            let known: Vec<&str> = SHAPES.iter().map(|(known, _)| *known).collect();
            return Err(format!(
                "elements of type {kind} are not read; sheets of straight elements are: {}",
                known.join(", ")
            ));
        };
        let set = keyword.get("ELSET");
        set.iter().for_each(|name| self.open_group(name.clone(), true, keyword));
        self.reading = OpenBlock::Elements { corners: *corners, set, row: Vec::new() };
        Ok(())
    }

    fn open_group(&mut self, name: String, of_elements: bool, keyword: &Keyword) {
        let (internal, instance) = (keyword.has("INTERNAL"), keyword.get("INSTANCE"));
        let group = NamedSet { name, of_elements, internal, instance, members: Vec::new(), line: keyword.line };
        self.body().groups.push(group);
    }

    fn group(&mut self, keyword: &Keyword) -> Result<(), String> {
        let of_elements = keyword.name == "ELSET";
        self.open_group(keyword.needed(&keyword.name)?, of_elements, keyword);
        if let Some(elements) = keyword.get("ELSET").filter(|_| !of_elements) {
            self.member(SetMember::NodesOf(elements));
        }
        self.reading = OpenBlock::Group { generate: keyword.has("GENERATE") };
        Ok(())
    }

    fn member(&mut self, member: SetMember) {
        if let Some(group) = self.body().groups.last_mut() {
            group.members.push(member);
        }
    }

    fn surface(&mut self, keyword: &Keyword) -> Result<(), String> {
        let (name, line) = (keyword.needed("NAME")?, keyword.line);
        match keyword.get("TYPE").map(|kind| kind.to_ascii_uppercase()).as_deref() {
            None | Some("ELEMENT") => {
                self.body().surfaces.push(ElementSides { name, rows: Vec::new(), line });
                self.reading = OpenBlock::Surface;
            }
            Some(_) => self.ignore(keyword),
        }
        Ok(())
    }

    fn row(&mut self, line: &str, at: usize) -> Result<(), String> {
        let cells: Vec<&str> = line.trim_end_matches(',').split(',').map(str::trim).collect();
        match &mut self.reading {
            OpenBlock::Nothing => {}
            OpenBlock::Nodes { grouped } => {
                let (number, grouped) = (whole(cells[0])?, *grouped);
                let place = padded(&cells[1..])?;
                self.body().nodes.push((number, place, at));
                if grouped {
                    self.member(SetMember::Range(number, number, 1));
                }
            }
            OpenBlock::Elements { corners, set, row } => {
                for cell in &cells {
                    row.push(whole(cell)?);
                }
                if row.len() > *corners {
                    let (numbers, set) = (std::mem::take(row), set.clone());
                    if numbers.len() != *corners + 1 {
                        return Err(format!("expected {} numbers, found {}", *corners + 1, numbers.len()));
                    }
                    if set.is_some() {
                        self.member(SetMember::Range(numbers[0], numbers[0], 1));
                    }
                    let element = FileElement { number: numbers[0], nodes: numbers[1..].to_vec(), set, line: at };
                    self.body().elements.push(element);
                }
            }
            OpenBlock::Group { generate } => {
                let generate = *generate;
                self.members(&cells, generate)?;
            }
            OpenBlock::Surface => {
                let row = (cells[0].trim_matches('"').to_string(), cells.get(1).unwrap_or(&"").to_ascii_uppercase());
                if let Some(surface) = self.body().surfaces.last_mut() {
                    surface.rows.push(row);
                }
            }
            OpenBlock::Place => self.place(&cells)?,
            OpenBlock::Orientation => {
                if let Some(orientation) = self.body().orientations.last_mut().filter(|it| it.other.is_none()) {
                    match number(cells[0]) {
                        Err(_) if orientation.rows.is_empty() => orientation.other = Some("DISTRIBUTION".into()),
                        _ => orientation.rows.push(numbers(&cells)?),
                    }
                }
            }
            OpenBlock::Pressed => self.model.pressed.push(cells[0].trim_matches('"').to_string()),
        }
        Ok(())
    }

    fn members(&mut self, cells: &[&str], generate: bool) -> Result<(), String> {
        if generate {
            let range = cells.iter().map(|cell| whole(cell)).collect::<Result<Vec<u64>, _>>()?;
            let (first, last, step) = match range[..] {
                [first, last] => (first, last, 1),
                [first, last, step] if step > 0 => (first, last, step),
                _ => return Err("write first, last and step, a whole number from 1".into()),
            };
            self.member(SetMember::Range(first, last, step));
            return Ok(());
        }
        for cell in cells.iter().filter(|cell| !cell.is_empty()) {
            self.member(match cell.parse() {
                Ok(number) => SetMember::Range(number, number, 1),
                Err(_) => SetMember::Named(cell.trim_matches('"').to_string()),
            });
        }
        Ok(())
    }

    /// First row of an instance: the way; second: two points of an axis and an angle.
    fn place(&mut self, cells: &[&str]) -> Result<(), String> {
        let Some(instance) = self.model.instances.last_mut() else { return Ok(()) };
        match cells.len() {
            7 => {
                let n = numbers(cells)?;
                instance.turned = Some(([n[0], n[1], n[2]], [n[3], n[4], n[5]], n[6].to_radians()));
            }
            0..=3 => instance.moved = padded(cells)?,
            count => return Err(format!("expected 3 numbers (a way) or 7 (an axis and an angle), found {count}")),
        }
        Ok(())
    }
}

/// Coordinates, of which the last may be left out.
fn padded(cells: &[&str]) -> Result<V3, String> {
    let cell = |k: usize| cells.get(k).filter(|cell| !cell.is_empty()).map_or(Ok(0.0), |cell| number(cell));
    Ok([cell(0)?, cell(1)?, cell(2)?])
}
