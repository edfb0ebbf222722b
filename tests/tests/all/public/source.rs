//! What other crates see of a library, by its source: modules, what they export, methods.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::{
    Attribute, Expr, Fields, ImplItem, Item, ItemImpl, Meta, TraitItem, UseTree, Visibility,
};

/// A module by its names from the root on, and a name in it.
type Place = (Vec<String>, String);

type Public<'a> = BTreeMap<Place, &'a Item>;

#[derive(Default)]
pub struct Source {
    modules: BTreeMap<Vec<String>, Vec<Item>>,
}

impl Source {
    /// From a library's folder.
    pub fn read(root: &Path) -> Self {
        let mut source = Self::default();
        let items = items(&root.join("lib.rs"));
        source.take(Vec::new(), items, Some(&root.to_owned()));
        source
    }

    /// From a text without files of its own.
    pub fn of(text: &str) -> Self {
        let mut source = Self::default();
        let file = syn::parse_file(text).expect("Rust");
        source.take(Vec::new(), file.items, None);
        source
    }

    /// A module with all that is below it but its tests; `folder` is where files of its children are.
    fn take(&mut self, at: Vec<String>, own: Vec<Item>, folder: Option<&PathBuf>) {
        for item in &own {
            let Item::Mod(module) = item else { continue };
            let name = module.ident.to_string();
            if says(&module.attrs, "test") {
                continue;
            }
            let below = folder.map(|folder| folder.join(&name));
            let children = match (&module.content, folder) {
                (Some((_, items)), _) => items.clone(),
                (None, Some(folder)) => {
                    let beside = folder.join(format!("{name}.rs"));
                    let within = folder.join(&name).join("mod.rs");
                    items(if beside.exists() { &beside } else { &within })
                }
                (None, None) => continue,
            };
            self.take([at.clone(), vec![name]].concat(), children, below.as_ref());
        }
        self.modules.insert(at, own);
    }

    /// Where a path leads that is written in a module.
    fn home(&self, module: &[String], path: &[String]) -> Option<Place> {
        let (first, rest) = path.split_first()?;
        let items = self.modules.get(module)?;
        match first.as_str() {
            "crate" => return self.home(&[], rest),
            "self" => return self.home(module, rest),
            "super" => return self.home(module.split_last()?.1, rest),
            _ => {}
        }
        if rest.is_empty() && items.iter().any(|item| name(item).as_ref() == Some(first)) {
            return Some((module.to_vec(), first.clone()));
        }
        let child = [module, std::slice::from_ref(first)].concat();
        if self.modules.contains_key(&child) && !rest.is_empty() {
            return self.home(&child, rest);
        }
        let mut imports = self.imports(module).into_iter();
        let import = imports.find(|(name, path)| name == first && path[0] != *first);
        import.and_then(|(_, path)| self.home(module, &[path.as_slice(), rest].concat()))
    }

    /// Names that a module imports, with their paths.
    fn imports(&self, module: &[String]) -> Vec<(String, Vec<String>)> {
        let imports = self.modules[module].iter().filter_map(|item| match item {
            Item::Use(import) => Some(flat(&import.tree)),
            _ => None,
        });
        imports.flatten().collect()
    }

    /// Everything that other crates can name.
    fn public(&self) -> Public<'_> {
        let mut found = BTreeSet::new();
        self.walk(&[], &mut found);
        let item = |(module, wanted): &Place| {
            let mut items = self.modules[module].iter();
            items.find(|item| name(item).as_ref() == Some(wanted))
        };
        let pairs = found.into_iter();
        pairs
            .filter_map(|place| Some((place.clone(), item(&place)?)))
            .collect()
    }

    fn walk(&self, at: &[String], found: &mut BTreeSet<Place>) {
        for item in &self.modules[at] {
            let (visibility, attributes) = match item {
                Item::Mod(it) => (&it.vis, &it.attrs),
                Item::Use(it) => (&it.vis, &it.attrs),
                Item::Struct(it) => (&it.vis, &it.attrs),
                Item::Enum(it) => (&it.vis, &it.attrs),
                Item::Trait(it) => (&it.vis, &it.attrs),
                Item::Type(it) => (&it.vis, &it.attrs),
                Item::Fn(it) => (&it.vis, &it.attrs),
                _ => continue,
            };
            if !is_open(visibility, attributes) {
                continue;
            }
            match item {
                Item::Mod(module) => self.walk(&[at, &[module.ident.to_string()]].concat(), found),
                Item::Use(import) => {
                    let paths = flat(&import.tree).into_iter();
                    found.extend(paths.filter_map(|(_, path)| self.home(at, &path)));
                }
                _ => found.extend(name(item).map(|name| (at.to_vec(), name))),
            }
        }
    }

    /// Blocks of public types, with the modules that they stand in and the paths of the types.
    fn blocks(&self, public: &Public<'_>) -> Vec<(&Vec<String>, String, &ItemImpl)> {
        let mut blocks = Vec::new();
        for (module, items) in &self.modules {
            for item in items {
                let Item::Impl(block) = item else { continue };
                let syn::Type::Path(of) = &*block.self_ty else {
                    continue;
                };
                let path = of.path.segments.iter().map(|part| part.ident.to_string());
                let home = self.home(module, &path.collect::<Vec<_>>());
                if let Some(home) = home.filter(|home| public.contains_key(home)) {
                    blocks.push((module, path_of(&home), block));
                }
            }
        }
        blocks
    }

    /// Public functions and methods, each with whether it has an example of its own.
    pub fn functions(&self) -> Vec<(String, bool)> {
        let public = self.public();
        let mut functions = Vec::new();
        for (place, item) in &public {
            let at = path_of(place);
            match item {
                Item::Fn(it) => functions.push((at, has_example(&it.attrs))),
                Item::Trait(it) => {
                    functions.extend(it.items.iter().filter_map(|item| match item {
                        TraitItem::Fn(it) => {
                            Some((format!("{at}::{}", it.sig.ident), has_example(&it.attrs)))
                        }
                        _ => None,
                    }));
                }
                _ => {}
            }
        }
        for (_, of, block) in self.blocks(&public) {
            if block.trait_.is_some() {
                continue;
            }
            functions.extend(block.items.iter().filter_map(|item| match item {
                ImplItem::Fn(it) if is_open(&it.vis, &it.attrs) => {
                    Some((format!("{of}::{}", it.sig.ident), has_example(&it.attrs)))
                }
                _ => None,
            }));
        }
        functions
    }

    /// Types that other crates can make from their fields, or match to the end.
    pub fn exhaustive(&self) -> BTreeSet<String> {
        let is_closed = |item: &Item| match item {
            Item::Struct(it) => {
                let mut fields = it.fields.iter();
                let are_open = fields.all(|field| matches!(field.vis, Visibility::Public(_)));
                are_open && !matches!(it.fields, Fields::Unit) && !says(&it.attrs, "non_exhaustive")
            }
            Item::Enum(it) => !says(&it.attrs, "non_exhaustive"),
            _ => false,
        };
        let public = self.public().into_iter();
        let closed = public.filter(|(_, item)| is_closed(item));
        closed.map(|(place, _)| path_of(&place)).collect()
    }

    /// Public signatures and fields that name a thing of one of these crates, with its name.
    pub fn leaks(&self, crates: &BTreeSet<String>) -> BTreeSet<(String, String)> {
        let mut leaks = BTreeSet::new();
        let mut look = |module: &[String], at: String, text: String| {
            let imports = self.imports(module).into_iter();
            let theirs = imports.filter(|(_, path)| crates.contains(&path[0]));
            let theirs: BTreeSet<String> = theirs.map(|(name, _)| name).collect();
            let words = text.split(|c: char| !c.is_alphanumeric() && c != '_');
            let found = words.filter(|&word| theirs.contains(word) || crates.contains(word));
            leaks.extend(found.map(|word| (at.clone(), word.to_owned())));
        };
        let public = self.public();
        for (place, item) in &public {
            let text = match item {
                Item::Fn(it) => text(&it.sig),
                Item::Type(it) => text(&it.ty),
                Item::Struct(it) => {
                    let fields = it.fields.iter();
                    let open = fields.filter(|field| matches!(field.vis, Visibility::Public(_)));
                    open.map(|field| text(&field.ty)).collect()
                }
                Item::Enum(it) => {
                    let fields = it.variants.iter().flat_map(|variant| &variant.fields);
                    fields.map(|field| text(&field.ty) + " ").collect()
                }
                Item::Trait(it) => {
                    let items = it.items.iter().filter_map(|item| match item {
                        TraitItem::Fn(it) => Some(text(&it.sig) + " "),
                        _ => None,
                    });
                    items.chain([text(&it.supertraits)]).collect()
                }
                _ => continue,
            };
            look(&place.0, path_of(place), text);
        }
        for (module, of, block) in self.blocks(&public) {
            // `impl From<csv::Error> for LogError`
            let made = block
                .trait_
                .as_ref()
                .and_then(|(made, _)| made.segments.last());
            if let Some(made) = made {
                look(module, of, text(&made.arguments));
                continue;
            }
            for item in &block.items {
                match item {
                    ImplItem::Fn(it) if is_open(&it.vis, &it.attrs) => {
                        look(module, of.clone(), text(&it.sig));
                    }
                    _ => {}
                }
            }
        }
        leaks
    }
}

fn path_of((module, name): &Place) -> String {
    let parts = module.iter().chain([name]).map(String::as_str);
    parts.collect::<Vec<_>>().join("::")
}

fn text(part: &impl ToTokens) -> String {
    part.to_token_stream().to_string()
}

fn items(file: &Path) -> Vec<Item> {
    let text = fs::read_to_string(file).expect("a file of the repository");
    syn::parse_file(&text).expect("Rust").items
}

fn name(item: &Item) -> Option<String> {
    let name = match item {
        Item::Struct(it) => &it.ident,
        Item::Enum(it) => &it.ident,
        Item::Trait(it) => &it.ident,
        Item::Type(it) => &it.ident,
        Item::Fn(it) => &it.sig.ident,
        _ => return None,
    };
    Some(name.to_string())
}

/// The names that a `use` brings, with their paths.
fn flat(tree: &UseTree) -> Vec<(String, Vec<String>)> {
    match tree {
        UseTree::Path(path) => {
            let first = vec![path.ident.to_string()];
            let below = flat(&path.tree).into_iter();
            below
                .map(|(name, rest)| (name, [first.clone(), rest].concat()))
                .collect()
        }
        UseTree::Name(it) => vec![(it.ident.to_string(), vec![it.ident.to_string()])],
        UseTree::Rename(it) => vec![(it.rename.to_string(), vec![it.ident.to_string()])],
        UseTree::Group(group) => group.items.iter().flat_map(flat).collect(),
        UseTree::Glob(_) => Vec::new(),
    }
}

fn is_open(visibility: &Visibility, attributes: &[Attribute]) -> bool {
    matches!(visibility, Visibility::Public(_)) && !says(attributes, "hidden")
}

/// Whether an attribute is this word, or has it as its argument.
fn says(attributes: &[Attribute], word: &str) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        Meta::Path(path) => path.is_ident(word),
        Meta::List(list) => list.tokens.to_string() == word,
        Meta::NameValue(_) => false,
    })
}

/// Whether there is a heading for examples, and code below it that asserts.
fn has_example(attributes: &[Attribute]) -> bool {
    let lines = attributes
        .iter()
        .filter_map(|attribute| match &attribute.meta {
            Meta::NameValue(pair) if pair.path.is_ident("doc") => Some(said(&pair.value)),
            // `#[cfg_attr(feature = "derive", doc = "```")]`
            Meta::List(list) if list.path.is_ident("cfg_attr") => {
                let parts =
                    list.parse_args_with(Punctuated::<Meta, syn::Token![,]>::parse_terminated);
                parts.ok()?.into_iter().find_map(|part| match part {
                    Meta::NameValue(pair) if pair.path.is_ident("doc") => Some(said(&pair.value)),
                    _ => None,
                })
            }
            _ => None,
        });
    let text = lines.collect::<Vec<_>>().join("\n");
    let below = text.split_once("# Examples").map(|(_, below)| below);
    let code = below.and_then(|below| below.split_once("```"));
    code.is_some_and(|(_, code)| code.contains("assert"))
}

/// A line of documentation; what a macro writes begins code.
fn said(value: &Expr) -> String {
    match value {
        Expr::Lit(syn::ExprLit {
            lit: syn::Lit::Str(text),
            ..
        }) => text.value(),
        _ => "```".to_owned(),
    }
}
