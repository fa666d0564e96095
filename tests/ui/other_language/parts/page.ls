<!DOCTYPE html>
<html>
<head><title>A plant</title></head>
<body><p>F[+F]F</p></body>
</html>
