//! Rewrites a file so that each place of a mutant is a switch. Lines keep their numbers.

use proc_macro2::Span;
use std::collections::BTreeSet;
use std::ops::Range;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Expr, Lit, UnOp};

/// A place where the program can be made wrong.
#[derive(Debug, Clone)]
pub struct Mutant {
    /// The number of its switch.
    pub id: u32,
    /// The room that it is in.
    pub room: String,
    /// The file, from the root of the repository.
    pub file: String,
    /// The line, from 1.
    pub line: usize,
    /// What becomes of what.
    pub what: String,
}

struct Rewriter<'a> {
    source: &'a str,
    out: String,
    /// Up to where the source has been copied.
    done: usize,
    room: &'a str,
    file: &'a str,
    /// Lines whose switches do not compile.
    skip: &'a BTreeSet<usize>,
    mutants: &'a mut Vec<Mutant>,
}

/// Rewrites one file.
///
/// # Errors
/// The message of the parser.
pub fn rewrite(
    source: &str,
    room: &str,
    file: &str,
    skip: &BTreeSet<usize>,
    mutants: &mut Vec<Mutant>,
) -> Result<String, String> {
    let parsed = syn::parse_file(source).map_err(|e| format!("{file}: {e}"))?;
    let mut rewriter = Rewriter { source, out: String::new(), done: 0, room, file, skip, mutants };
    if let Some(first) = parsed.items.first() {
        rewriter.copy_to(first.span().byte_range().start);
        rewriter.out.push_str("#[allow(unused_imports)] use crate::mutant::{FloatPick as _, OrdPick as _}; ");
    }
    parsed.items.iter().for_each(|item| rewriter.visit_item(item));
    rewriter.copy_to(source.len());
    Ok(rewriter.out)
}

impl Rewriter<'_> {
    fn copy_to(&mut self, position: usize) {
        assert!(self.done <= position, "{}: {} after {position}", self.file, self.done);
        self.out.push_str(&self.source[self.done..position]);
        self.done = position;
    }

    /// Writes `text` in the place of a range of the source.
    fn replace(&mut self, range: Range<usize>, text: &str) {
        self.copy_to(range.start);
        // Comments may end a line within an operator's range only in theory; lines are kept all the same.
        self.out.extend(self.source[range.clone()].matches('\n'));
        self.out.push_str(text);
        self.done = range.end;
    }

    fn insert(&mut self, position: usize, text: &str) {
        self.replace(position..position, text);
    }

    /// A new switch, unless one on this line does not compile.
    fn switch(&mut self, at: Span, what: String) -> Option<u32> {
        let line = at.start().line;
        if self.skip.contains(&line) {
            return None;
        }
        let id = u32::try_from(self.mutants.len() + 1).expect("few mutants");
        let (room, file) = (self.room.to_owned(), self.file.to_owned());
        self.mutants.push(Mutant { id, room, file, line, what });
        Some(id)
    }

    fn comparison(&mut self, e: &syn::ExprBinary, name: &str, what: &str) {
        let Some(id) = self.switch(e.op.span(), what.to_owned()) else { return visit::visit_expr_binary(self, e) };
        let range = e.span().byte_range();
        self.insert(range.start, &format!("crate::mutant::{name}({id}, &("));
        self.visit_expr(&e.left);
        self.replace(e.op.span().byte_range(), "), &(");
        self.visit_expr(&e.right);
        self.insert(range.end, "))");
    }

    /// `a && b` is `if a { b } else { a }`, and `a || b` is `if !a { b } else { a }`: the mutant takes the other.
    fn connective(&mut self, e: &syn::ExprBinary, and: bool) {
        let what = if and { "&& becomes ||" } else { "|| becomes &&" };
        let Some(id) = self.switch(e.op.span(), what.to_owned()) else { return visit::visit_expr_binary(self, e) };
        let range = e.span().byte_range();
        self.insert(range.start, "({ let __m: bool = (");
        self.visit_expr(&e.left);
        let sign = if and { "!=" } else { "==" };
        self.replace(e.op.span().byte_range(), &format!("); if __m {sign} crate::mutant::on({id}) {{ "));
        self.visit_expr(&e.right);
        self.insert(range.end, " } else { __m } })");
    }
}

/// Whether an expression is a chain with a `let`, which is no expression of type `bool`.
fn has_let(e: &Expr) -> bool {
    match e {
        Expr::Let(_) => true,
        Expr::Binary(b) => has_let(&b.left) || has_let(&b.right),
        _ => false,
    }
}

fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|a| {
        let text = a.path().segments.last().map(|s| s.ident.to_string());
        text.as_deref() == Some("test")
            || (a.path().is_ident("cfg") && matches!(&a.meta, syn::Meta::List(l) if l.tokens.to_string() == "test"))
    })
}

impl<'ast> Visit<'ast> for Rewriter<'_> {
    fn visit_item_mod(&mut self, _: &'ast syn::ItemMod) {}
    fn visit_item_const(&mut self, _: &'ast syn::ItemConst) {}
    fn visit_item_static(&mut self, _: &'ast syn::ItemStatic) {}
    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_item_enum(&mut self, _: &'ast syn::ItemEnum) {}
    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_pat(&mut self, _: &'ast syn::Pat) {}
    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {}
    fn visit_generic_argument(&mut self, _: &'ast syn::GenericArgument) {}

    fn visit_item_fn(&mut self, f: &'ast syn::ItemFn) {
        if f.sig.constness.is_none() && !is_test(&f.attrs) {
            visit::visit_block(self, &f.block);
        }
    }

    fn visit_impl_item_fn(&mut self, f: &'ast syn::ImplItemFn) {
        if f.sig.constness.is_none() && !is_test(&f.attrs) {
            visit::visit_block(self, &f.block);
        }
    }

    fn visit_item_impl(&mut self, i: &'ast syn::ItemImpl) {
        // Words are held by other tests.
        let name = i.trait_.as_ref().and_then(|(_, path, _)| path.segments.last()).map(|s| s.ident.to_string());
        if !matches!(name.as_deref(), Some("Display" | "Debug" | "Error")) {
            visit::visit_item_impl(self, i);
        }
    }

    fn visit_expr_const(&mut self, _: &'ast syn::ExprConst) {}

    fn visit_expr_repeat(&mut self, e: &'ast syn::ExprRepeat) {
        self.visit_expr(&e.expr);
    }

    fn visit_expr_binary(&mut self, e: &'ast syn::ExprBinary) {
        match e.op {
            BinOp::Lt(_) => self.comparison(e, "lt", "< becomes <="),
            BinOp::Le(_) => self.comparison(e, "le", "<= becomes <"),
            BinOp::Gt(_) => self.comparison(e, "gt", "> becomes >="),
            BinOp::Ge(_) => self.comparison(e, "ge", ">= becomes >"),
            BinOp::Eq(_) => self.comparison(e, "eq", "== becomes !="),
            BinOp::Ne(_) => self.comparison(e, "ne", "!= becomes =="),
            BinOp::And(_) if !has_let(&e.left) && !has_let(&e.right) => self.connective(e, true),
            BinOp::Or(_) => self.connective(e, false),
            _ => visit::visit_expr_binary(self, e),
        }
    }

    fn visit_expr_unary(&mut self, e: &'ast syn::ExprUnary) {
        let switch = if matches!(e.op, UnOp::Not(_)) { self.switch(e.op.span(), "! is left out".to_owned()) } else { None };
        let Some(id) = switch else { return visit::visit_expr_unary(self, e) };
        self.replace(e.op.span().byte_range(), &format!("crate::mutant::not({id}, "));
        self.visit_expr(&e.expr);
        self.insert(e.span().byte_range().end, ")");
    }

    fn visit_expr_lit(&mut self, e: &'ast syn::ExprLit) {
        let (name, what) = match &e.lit {
            Lit::Bool(b) => ("flag", format!("{} becomes {}", b.value, !b.value)),
            Lit::Int(i) => match i.base10_parse::<u64>() {
                Ok(value) if value <= 16 => ("int", format!("{value} becomes {}", value + 1)),
                _ => return,
            },
            _ => return,
        };
        let Some(id) = self.switch(e.span(), what) else { return };
        let range = e.span().byte_range();
        self.insert(range.start, &format!("crate::mutant::{name}({id}, "));
        self.insert(range.end, ")");
    }

    fn visit_expr_method_call(&mut self, e: &'ast syn::ExprMethodCall) {
        self.visit_expr(&e.receiver);
        let method = e.method.to_string();
        if matches!(method.as_str(), "min" | "max") && e.args.len() == 1 && e.turbofish.is_none() {
            let other = if method == "min" { "max" } else { "min" };
            if let Some(id) = self.switch(e.method.span(), format!("{method} becomes {other}")) {
                self.replace(e.method.span().byte_range(), &format!("mutant_{method}"));
                self.insert(e.args[0].span().byte_range().start, &format!("{id}, "));
            }
        }
        e.args.iter().for_each(|a| self.visit_expr(a));
    }
}
