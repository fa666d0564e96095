// a curve
lsystem dragon {
    vocabulary {
        L, R: draw;
    }
    rules {
        axiom -> L;
        L -> L+R+;
        R -> -L-R;
    }
    angle = 90;
}
