//! Keyword lines, and which of them say something about a mesh.

/// Elements that are sheets, and their corners.
pub(super) const SHAPES: [(&str, usize); 15] = [
    ("M3D3", 3),
    ("M3D4", 4),
    ("M3D4R", 4),
    ("S3", 3),
    ("S3R", 3),
    ("S3RS", 3),
    ("STRI3", 3),
    ("DS3", 3),
    ("SFM3D3", 3),
    ("S4", 4),
    ("S4R", 4),
    ("S4RS", 4),
    ("S4RSW", 4),
    ("SFM3D4", 4),
    ("SFM3D4R", 4),
];

/// Keywords that make or join parts of the mesh, and what to do instead.
pub(super) const REFUSED: [(&str, &str); 13] = [
    ("INCLUDE", "put the text of that file here"),
    ("TIE", "merge the nodes (Assembly, Merge instances)"),
    ("EQUATION", "merge the nodes"),
    ("MPC", "merge the nodes"),
    ("EMBEDDEDELEMENT", "write the plies of a part into the case"),
    ("SYSTEM", "write the coordinates of the nodes in the global system"),
    ("NGEN", "write the nodes out, as Abaqus/CAE does"),
    ("NFILL", "write the nodes out, as Abaqus/CAE does"),
    ("NCOPY", "write the nodes out, as Abaqus/CAE does"),
    ("NMAP", "write the nodes out, as Abaqus/CAE does"),
    ("ELGEN", "write the elements out, as Abaqus/CAE does"),
    ("ELCOPY", "write the elements out, as Abaqus/CAE does"),
    ("KEYWORD", "this is LS-DYNA; convert it to Abaqus input"),
];

/// Keywords about materials, loads and results, which a case has in its own words, one space apart.
pub(super) const IGNORED: &str = "\
    HEADING PREPRINT MATERIAL DENSITY ELASTIC HYPERELASTIC PLASTIC FABRIC UNIAXIAL \
    LOADINGDATA UNLOADINGDATA UNIAXIALTESTDATA BIAXIALTESTDATA PLANARTESTDATA NOCOMPRESSION \
    VISCOELASTIC DAMPING EXPANSION DEPVAR USERMATERIAL DISTRIBUTION DISTRIBUTIONTABLE \
    NODALTHICKNESS TRANSVERSESHEARSTIFFNESS TRANSVERSESHEAR HOURGLASSSTIFFNESS \
    SECTIONCONTROLS AMPLITUDE BOUNDARY INITIALCONDITIONS PHYSICALCONSTANTS \
    SURFACEINTERACTION SURFACEBEHAVIOR FRICTION CONTACT CONTACTINCLUSIONS CONTACTEXCLUSIONS \
    CONTACTPROPERTYASSIGNMENT CONTACTPAIR CONTACTDAMPING SURFACEPROPERTYASSIGNMENT RIGIDBODY \
    COUPLING KINEMATIC DISTRIBUTING FLUIDCAVITY FLUIDBEHAVIOR FLUIDDENSITY MOLECULARWEIGHT \
    CAPACITY FLUIDINFLATOR TRANSFORM PARAMETER RESTART FILTER";

pub(super) struct Keyword {
    /// Name of the keyword in capitals, without spaces.
    pub(super) name: String,
    pub(super) written: String,
    pub(super) line: usize,
    parameters: Vec<(String, Option<String>)>,
}

impl Keyword {
    pub(super) fn of(text: &str, line: usize) -> Keyword {
        let mut cells = text.split(',').map(str::trim);
        let written = cells.next().unwrap_or("").to_ascii_uppercase();
        let parameter = |cell: &str| {
            let (name, value) = cell.split_once('=').map_or((cell, None), |(name, value)| (name, Some(value)));
            (squeezed(name), value.map(|value| value.trim().trim_matches('"').to_string()))
        };
        let parameters = cells.filter(|cell| !cell.is_empty()).map(parameter).collect();
        Keyword { name: squeezed(&written), written, line, parameters }
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.parameters.iter().any(|(known, _)| known == name)
    }

    pub(super) fn get(&self, name: &str) -> Option<String> {
        self.parameters.iter().find(|(known, _)| known == name)?.1.clone()
    }

    pub(super) fn needed(&self, name: &str) -> Result<String, String> {
        self.get(name).ok_or_else(|| format!("*{} needs {name}=…", self.written))
    }

    pub(super) fn without(&self, name: &str, instead: &str) -> Result<(), String> {
        match self.has(name) {
            true => Err(format!("*{}, {name}=… is not read: {instead}", self.written)),
            false => Ok(()),
        }
    }
}

fn squeezed(name: &str) -> String {
    name.split_whitespace().collect::<String>().to_ascii_uppercase()
}
