//! Text of the Calculator as expressions.

/// Nesting of an expression.
const MAX_DEPTH: usize = 64;
/// Operators and operands of one text: trees are calculated by recursion.
const MAX_PARTS: usize = 1000;
/// Letters of one text; longer ones are not read.
const MAX_LENGTH: usize = 65_536;

/// `name[index] = value`.
pub(super) struct Statement {
    pub name: String,
    pub index: Option<usize>,
    pub value: Expression,
}

pub(super) enum Expression {
    Number(f64),
    Name(String),
    Part(Box<Self>, usize),
    Negative(Box<Self>),
    Not(Box<Self>),
    /// Condition, then, else.
    Choice(Box<[Self; 3]>),
    Binary(&'static str, Box<[Self; 2]>),
    Call(String, Vec<Self>),
}

/// Operators from the weakest to the strongest.
const LEVELS: [&[&str]; 6] = [
    &["||"],
    &["&&"],
    &["==", "!="],
    &["<=", ">=", "<", ">"],
    &["+", "-"],
    &["*", "/", "%"],
];

/// The constants.
const CONSTANTS: [(&str, f64); 17] = [
    ("MAXFLOAT", f32::MAX as f64),
    ("MINFLOAT", f32::MIN_POSITIVE as f64),
    ("M_E", std::f64::consts::E),
    ("M_LOG2E", std::f64::consts::LOG2_E),
    ("M_LOG10E", std::f64::consts::LOG10_E),
    ("M_LN2", std::f64::consts::LN_2),
    ("M_LN10", std::f64::consts::LN_10),
    ("M_PI", std::f64::consts::PI),
    ("M_TWO_PI", std::f64::consts::TAU),
    ("M_PI_2", std::f64::consts::FRAC_PI_2),
    ("M_PI_4", std::f64::consts::FRAC_PI_4),
    ("M_1_PI", std::f64::consts::FRAC_1_PI),
    ("M_2_PI", std::f64::consts::FRAC_2_PI),
    ("M_2_SQRTPI", std::f64::consts::FRAC_2_SQRT_PI),
    ("M_SQRT2", std::f64::consts::SQRT_2),
    ("M_SQRT1_2", std::f64::consts::FRAC_1_SQRT_2),
    ("M_DEG_RAD", std::f64::consts::PI / 180.0),
];

/// The statements of a text; `None` if it is none of the Calculator's.
pub(super) fn parse(text: &str) -> Option<Vec<Statement>> {
    if text.len() > MAX_LENGTH {
        return None;
    }
    let mut parser = Parser {
        rest: text,
        depth: 0,
        parts: 0,
    };
    let mut statements = Vec::new();
    loop {
        while parser.takes(";") {}
        if parser.rest.trim_start().is_empty() {
            return Some(statements);
        }
        statements.push(parser.statement()?);
        if !parser.rest.trim_start().is_empty() && !parser.takes(";") {
            return None;
        }
    }
}

struct Parser<'t> {
    rest: &'t str,
    depth: usize,
    parts: usize,
}

impl<'t> Parser<'t> {
    fn takes(&mut self, token: &str) -> bool {
        let rest = self.rest.trim_start();
        let found = rest.strip_prefix(token);
        self.rest = found.unwrap_or(rest);
        found.is_some()
    }

    fn word(&mut self) -> Option<&'t str> {
        let rest = self.rest.trim_start();
        let is_inner = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let end = rest.find(|c| !is_inner(c)).unwrap_or(rest.len());
        let starts = rest.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
        let (word, after) = rest.split_at(end);
        starts.then(|| {
            self.rest = after;
            word
        })
    }

    fn statement(&mut self) -> Option<Statement> {
        let name = self.word()?.to_owned();
        // Inputs cannot be assigned to.
        let legal = name.len() == 2 && name.starts_with(['t', 'o']);
        let index = self.index()?;
        if !legal || !self.takes("=") {
            return None;
        }
        let value = self.choice()?;
        Some(Statement { name, index, value })
    }

    /// `[2]`, if there is one; the outer `None` for something else in brackets.
    fn index(&mut self) -> Option<Option<usize>> {
        if !self.takes("[") {
            return Some(None);
        }
        let rest = self.rest.trim_start();
        let digit = rest.chars().next()?.to_digit(10)?;
        self.rest = &rest[1..];
        (digit < 3 && self.takes("]")).then_some(Some(digit as usize))
    }

    fn choice(&mut self) -> Option<Expression> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return None;
        }
        let condition = self.level(0)?;
        let made = if self.takes("?") {
            let yes = self.choice()?;
            self.takes(":").then_some(())?;
            let no = self.choice()?;
            Expression::Choice(Box::new([condition, yes, no]))
        } else {
            condition
        };
        self.depth -= 1;
        Some(made)
    }

    fn level(&mut self, level: usize) -> Option<Expression> {
        let Some(operators) = LEVELS.get(level) else {
            return self.unary();
        };
        let mut left = self.level(level + 1)?;
        while let Some(operator) = operators.iter().find(|operator| self.takes(operator)) {
            let right = self.level(level + 1)?;
            left = Expression::Binary(operator, Box::new([left, right]));
        }
        Some(left)
    }

    fn unary(&mut self) -> Option<Expression> {
        self.depth += 1;
        self.parts += 1;
        if self.depth > MAX_DEPTH || self.parts > MAX_PARTS {
            return None;
        }
        let made = if self.takes("-") {
            Expression::Negative(Box::new(self.unary()?))
        } else if self.takes("!") {
            Expression::Not(Box::new(self.unary()?))
        } else {
            let whole = self.primary()?;
            match self.index()? {
                Some(index) => Expression::Part(Box::new(whole), index),
                None => whole,
            }
        };
        self.depth -= 1;
        Some(made)
    }

    fn primary(&mut self) -> Option<Expression> {
        if self.takes("(") {
            let inner = self.choice()?;
            return self.takes(")").then_some(inner);
        }
        let Some(word) = self.word() else {
            return self.number();
        };
        if self.takes("(") {
            let mut arguments = vec![self.choice()?];
            while self.takes(",") {
                arguments.push(self.choice()?);
            }
            return self
                .takes(")")
                .then(|| Expression::Call(word.to_owned(), arguments));
        }
        let constant = CONSTANTS.iter().find(|(name, _)| *name == word);
        if let Some((_, value)) = constant {
            return Some(Expression::Number(*value));
        }
        let letter = |c: char| matches!(c, 'a'..='h' | 'A'..='H');
        let mut letters = word.chars();
        let is_name = match (letters.next(), letters.next(), letters.next()) {
            (Some(c), None, _) => letter(c),
            (Some('t' | 'o'), Some(c), None) => letter(c),
            _ => false,
        };
        is_name.then(|| Expression::Name(word.to_owned()))
    }

    fn number(&mut self) -> Option<Expression> {
        let rest = self.rest.trim_start();
        let mut end = 0;
        let mut before = ' ';
        for c in rest.chars() {
            let sign = matches!(c, '+' | '-') && matches!(before, 'e' | 'E');
            if !(c.is_ascii_digit() || sign || matches!(c, '.' | 'e' | 'E')) {
                break;
            }
            end += 1;
            before = c;
        }
        let number = rest[..end].parse().ok()?;
        self.rest = &rest[end..];
        Some(Expression::Number(number))
    }
}
